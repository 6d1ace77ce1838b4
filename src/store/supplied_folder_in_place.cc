// Of builds whose program is not a file: what comes with it lies where the variable says, or in the sources.
#include <cstdlib>

#include "case/to_path.h"
#include "store/supplied_folder.h"

namespace rheocyte {

std::filesystem::path supplied_folder(const char* variable, const std::filesystem::path&,
                                      const std::filesystem::path& source) {
  const char* given = std::getenv(variable);
  return given ? to_path(given) : source;
}

}  // namespace rheocyte

#include <string>
#include <system_error>

#include "case/to_path.h"
#include "store/environment.h"
#include "store/program_file.h"
#include "store/supplied_folder.h"

namespace rheocyte {

namespace fs = std::filesystem;

/// The program stands beside the folder `share`, not in a folder beside it.
fs::path supplied_folder(const char* variable, const fs::path& installed, const fs::path& source) {
  if (const std::string given = environment(variable); !given.empty()) return to_path(given);
  const fs::path place = program_file().parent_path() / installed.lexically_relative("..");
  std::error_code error;
  return fs::exists(place, error) ? place : source;
}

}  // namespace rheocyte

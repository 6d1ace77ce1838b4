#include "case/split.h"
#include "case/to_path.h"
#include "store/environment.h"

namespace rheocyte {

std::vector<std::filesystem::path> folders_in(const char* variable) {
  std::vector<std::filesystem::path> folders;
  for (const std::string& folder : split(environment(variable), list_separator))
    if (!folder.empty()) folders.push_back(to_path(folder));
  return folders;
}

}  // namespace rheocyte

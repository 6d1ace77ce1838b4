#include "case/split.h"
#include "store/environment.h"

namespace rheocyte {

std::vector<std::filesystem::path> folders_in(const char* variable) {
  std::vector<std::filesystem::path> folders;
  for (const std::string& folder : split(environment(variable), list_separator))
    if (!folder.empty()) folders.emplace_back(folder);
  return folders;
}

}  // namespace rheocyte

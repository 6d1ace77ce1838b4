#include "store/environment.h"

#include <unistd.h>

#include <algorithm>
#include <cstdlib>

namespace rheocyte {

namespace fs = std::filesystem;

const char* const python_name = "python3";

std::string environment(const char* variable) {
  const char* const value = std::getenv(variable);
  return value ? value : "";
}

fs::path prefix_of_program(const fs::path& program) { return program.parent_path().parent_path(); }

std::vector<fs::path> folders_in(const char* variable) {
  const std::string search = environment(variable);
  std::vector<fs::path> folders;
  for (std::size_t at = 0; at < search.size();) {
    const auto end = std::min(search.find(':', at), search.size());
    if (end > at) folders.emplace_back(search.substr(at, end - at));
    at = end + 1;
  }
  return folders;
}

fs::path program_in_path(const std::string& name) {
  for (const auto& folder : folders_in("PATH"))
    if (fs::path program = folder / name; ::access(program.c_str(), X_OK) == 0) return program;
  return {};
}

}  // namespace rheocyte

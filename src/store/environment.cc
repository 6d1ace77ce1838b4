#include "store/environment.h"

#include <unistd.h>

#include <cstdlib>

#include "case/to_path.h"

namespace rheocyte {

namespace fs = std::filesystem;

const char list_separator = ':';
const char* const python_name = "python3";

std::string environment(const char* variable) {
  const char* const value = std::getenv(variable);
  return value ? value : "";
}

fs::path prefix_of_program(const fs::path& program) { return program.parent_path().parent_path(); }

fs::path program_in_path(const std::string& name) {
  for (const auto& folder : folders_in("PATH"))
    if (fs::path program = folder / to_path(name); ::access(program.c_str(), X_OK) == 0) return program;
  return {};
}

}  // namespace rheocyte

#include <windows.h>

#include "case/to_path.h"
#include "store/environment.h"
#include "store/windows_errors.h"

namespace rheocyte {

namespace fs = std::filesystem;

const char list_separator = ';';
const char* const python_name = "python";

std::string environment(const char* variable) {
  const wchar_t* const value = ::_wgetenv(wide(variable).c_str());
  return value ? narrow(value) : "";
}

fs::path program_in_path(const std::string& name) {
  std::error_code error;
  for (const auto& folder : folders_in("PATH"))
    if (fs::path program = folder / to_path(name + ".exe"); fs::is_regular_file(program, error)) return program;
  return {};
}

/// Python stands beside its packages, in a virtual environment in a folder of them.
fs::path prefix_of_program(const fs::path& program) {
  const fs::path folder = program.parent_path();
  return folder.filename() == "Scripts" ? folder.parent_path() : folder;
}

}  // namespace rheocyte

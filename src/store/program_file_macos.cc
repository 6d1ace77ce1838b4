// Compiled, not run (tools/macos).
#include <mach-o/dyld.h>

#include <cstdint>
#include <string>
#include <system_error>

#include "case/to_path.h"
#include "store/program_file.h"

namespace rheocyte {

std::filesystem::path program_file() {
  std::uint32_t size = 0;
  ::_NSGetExecutablePath(nullptr, &size);
  std::string name(size, '\0');
  std::error_code error;
  if (::_NSGetExecutablePath(name.data(), &size) != 0) return {};
  return std::filesystem::weakly_canonical(to_path(name.c_str()), error);
}

}  // namespace rheocyte

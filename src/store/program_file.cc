#include "store/program_file.h"

#include <system_error>

namespace rheocyte {

std::filesystem::path program_file() {
  std::error_code error;
  return std::filesystem::read_symlink("/proc/self/exe", error);
}

}  // namespace rheocyte

// Compiled, not run (tools/macos).
#include <dlfcn.h>

#include <cstdlib>
#include <system_error>

#include "case/to_path.h"
#include "store/program_file.h"
#include "store/supplied_folder.h"

namespace rheocyte {

namespace fs = std::filesystem;

namespace {

/// Of the program, or of the library that this code is part of, as in Python.
fs::path own_folder() {
  Dl_info place{};
  if (::dladdr(reinterpret_cast<const void*>(&program_file), &place) == 0) return program_file().parent_path();
  std::error_code error;
  return fs::weakly_canonical(to_path(place.dli_fname), error).parent_path();
}

}  // namespace

fs::path supplied_folder(const char* variable, const fs::path& installed, const fs::path& source) {
  if (const char* given = std::getenv(variable)) return to_path(given);
  const fs::path place = own_folder() / installed;
  std::error_code error;
  return fs::exists(place, error) ? place : source;
}

}  // namespace rheocyte

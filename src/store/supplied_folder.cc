#include "store/supplied_folder.h"

#include <dlfcn.h>
#include <link.h>

#include <cstdlib>
#include <system_error>

#include "case/to_path.h"
#include "store/program_file.h"

namespace rheocyte {

namespace {

// Of the shared library that this code is part of, as in Python, where the program is the interpreter; else that of the
// program. Only libraries have a name in the list of what is loaded.
std::filesystem::path own_folder() {
  Dl_info place{};
  link_map* entry = nullptr;
  const bool found =
      ::dladdr1(reinterpret_cast<void*>(&program_file), &place, reinterpret_cast<void**>(&entry), RTLD_DL_LINKMAP) != 0;
  if (!found || entry == nullptr || *entry->l_name == '\0') return program_file().parent_path();
  std::error_code error;
  return std::filesystem::weakly_canonical(to_path(entry->l_name), error).parent_path();
}

}  // namespace

std::filesystem::path supplied_folder(const char* variable, const std::filesystem::path& installed,
                                      const std::filesystem::path& source) {
  if (const char* given = std::getenv(variable)) return to_path(given);
  const std::filesystem::path place = own_folder() / installed;
  std::error_code error;
  return std::filesystem::exists(place, error) ? place : source;
}

}  // namespace rheocyte

#include <windows.h>

#include <string>
#include <system_error>

#include "case/to_path.h"
#include "store/environment.h"
#include "store/supplied_folder.h"

namespace rheocyte {

namespace fs = std::filesystem;

namespace {

/// Of the library that this code is part of, else of the program.
fs::path own_folder() {
  HMODULE module = nullptr;
  ::GetModuleHandleExW(GET_MODULE_HANDLE_EX_FLAG_FROM_ADDRESS | GET_MODULE_HANDLE_EX_FLAG_UNCHANGED_REFCOUNT,
                       reinterpret_cast<LPCWSTR>(&own_folder), &module);
  std::wstring name(32768, L'\0');
  name.resize(::GetModuleFileNameW(module, name.data(), static_cast<DWORD>(name.size())));
  return fs::path(name).parent_path();
}

}  // namespace

/// The program stands beside the folder `share`, not in a folder beside it.
fs::path supplied_folder(const char* variable, const fs::path& installed, const fs::path& source) {
  if (const std::string given = environment(variable); !given.empty()) return to_path(given);
  const fs::path place = own_folder() / installed.lexically_relative("..");
  std::error_code error;
  return fs::exists(place, error) ? place : source;
}

}  // namespace rheocyte

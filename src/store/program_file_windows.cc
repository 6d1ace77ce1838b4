#include <windows.h>

#include <string>

#include "store/program_file.h"

namespace rheocyte {

std::filesystem::path program_file() {
  std::wstring name(32768, L'\0');
  name.resize(::GetModuleFileNameW(nullptr, name.data(), static_cast<DWORD>(name.size())));
  return std::filesystem::path(name);
}

}  // namespace rheocyte

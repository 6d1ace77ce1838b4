// How the standard library reads folders, with paths of any length: the functions of mingw-w64 stop at 260 characters,
// and removing a folder then never ends. The linker takes these in their place; a program has to name this file as its
// own.
#include <dirent.h>
#include <windows.h>

#include <cerrno>
#include <cwchar>
#include <new>
#include <string>

#include "store/windows_errors.h"

namespace {

/// What a _WDIR points to.
struct OpenFolder {
  HANDLE search = INVALID_HANDLE_VALUE;
  WIN32_FIND_DATAW found{};
  bool is_first = true;
  _wdirent entry{};
};

OpenFolder* folder_of(_WDIR* opened) { return reinterpret_cast<OpenFolder*>(opened); }

}  // namespace

// NOLINTBEGIN(bugprone-reserved-identifier, readability-identifier-naming)
extern "C" {

_WDIR* _wopendir(const wchar_t* name) {
  const DWORD kind = ::GetFileAttributesW(name);
  if (kind == INVALID_FILE_ATTRIBUTES || (kind & FILE_ATTRIBUTE_DIRECTORY) == 0) {
    errno = kind == INVALID_FILE_ATTRIBUTES ? rheocyte::last_error() : ENOTDIR;
    return nullptr;
  }
  const auto opened = new (std::nothrow) OpenFolder;
  if (!opened) {
    errno = ENOMEM;
    return nullptr;
  }
  opened->search = ::FindFirstFileW((std::wstring(name) + L"\\*").c_str(), &opened->found);
  if (opened->search != INVALID_HANDLE_VALUE) return reinterpret_cast<_WDIR*>(opened);
  errno = rheocyte::last_error();
  delete opened;
  return nullptr;
}

_wdirent* _wreaddir(_WDIR* opened) {
  OpenFolder& folder = *folder_of(opened);
  if (!folder.is_first && !::FindNextFileW(folder.search, &folder.found)) {
    if (::GetLastError() != ERROR_NO_MORE_FILES) errno = rheocyte::last_error();
    return nullptr;
  }
  folder.is_first = false;
  std::wcscpy(folder.entry.d_name, folder.found.cFileName);
  folder.entry.d_namlen = static_cast<unsigned short>(std::wcslen(folder.entry.d_name));
  return &folder.entry;
}

int _wclosedir(_WDIR* opened) {
  ::FindClose(folder_of(opened)->search);
  delete folder_of(opened);
  return 0;
}
}
// NOLINTEND(bugprone-reserved-identifier, readability-identifier-naming)

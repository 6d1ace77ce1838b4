#include "store/windows_errors.h"

#include <windows.h>

#include <cerrno>
#include <system_error>

#include "case/to_path.h"

namespace rheocyte {

int last_error() {
  const DWORD number = ::GetLastError();
  switch (number) {
    case ERROR_SHARING_VIOLATION:
    case ERROR_LOCK_VIOLATION:
    case ERROR_IO_PENDING: return EWOULDBLOCK;
    case ERROR_ALREADY_EXISTS:
    case ERROR_FILE_EXISTS: return EEXIST;
    case ERROR_DISK_FULL:
    case ERROR_HANDLE_DISK_FULL: return ENOSPC;
    case ERROR_BAD_PATHNAME:
    case ERROR_INVALID_NAME:
    case ERROR_DIRECTORY: return ENOENT;
    default: break;
  }
  const std::error_condition condition = std::system_category().default_error_condition(static_cast<int>(number));
  return condition.category() == std::generic_category() && condition.value() != 0 ? condition.value() : EIO;
}

std::wstring wide(const std::string& utf8) { return to_path(utf8).wstring(); }

std::string narrow(const wchar_t* text) {
  const std::u8string utf8 = std::filesystem::path(text).u8string();
  return {utf8.begin(), utf8.end()};
}

void pause_ms(int milliseconds) { ::Sleep(static_cast<DWORD>(milliseconds)); }

bool may_be_in_use(int error) { return error == EWOULDBLOCK || error == EACCES || error == EBUSY; }

}  // namespace rheocyte

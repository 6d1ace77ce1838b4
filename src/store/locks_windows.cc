// Claims by the locks of Windows, and for folders by opening them so that no one else can open them in the same way.
#include <fcntl.h>
#include <io.h>
#include <windows.h>

#include <cerrno>

#include "store/claim.h"
#include "store/windows_errors.h"

namespace rheocyte {

namespace fs = std::filesystem;

namespace {

constexpr DWORD fraction_all = FILE_SHARE_READ | FILE_SHARE_WRITE | FILE_SHARE_DELETE;

Claiming opened(const fs::path& path, DWORD access, DWORD sharing, DWORD how, DWORD flags) {
  const HANDLE handle = ::CreateFileW(path.c_str(), access, sharing, nullptr, how, flags, nullptr);
  if (handle == INVALID_HANDLE_VALUE) return {{}, last_error()};
  const int descriptor = ::_open_osfhandle(reinterpret_cast<std::intptr_t>(handle), _O_BINARY | _O_NOINHERIT);
  if (descriptor < 0) ::CloseHandle(handle);
  return {Claim(descriptor), descriptor < 0 ? EMFILE : 0};
}

Claiming opened_file(const fs::path& path, DWORD how) {
  return opened(path, GENERIC_READ | GENERIC_WRITE, fraction_all, how,
                FILE_ATTRIBUTE_NORMAL | FILE_FLAG_OPEN_REPARSE_POINT);
}

// Other programs may list it and put files there, which does not open it for writing.
Claiming opened_folder(const fs::path& path) {
  return opened(path, FILE_ADD_FILE | SYNCHRONIZE, FILE_SHARE_READ | FILE_SHARE_DELETE, OPEN_EXISTING,
                FILE_FLAG_BACKUP_SEMANTICS | FILE_FLAG_OPEN_REPARSE_POINT);
}

// A byte far behind the end of every file: what is locked can be neither read nor written.
Claiming locked(Claiming opened, IfHeld if_held) {
  if (opened.failed) return opened;
  OVERLAPPED place{};
  place.OffsetHigh = 0x3FFFFFFF;
  const DWORD how = LOCKFILE_EXCLUSIVE_LOCK | (if_held == IfHeld::fail ? LOCKFILE_FAIL_IMMEDIATELY : 0);
  const auto handle = reinterpret_cast<HANDLE>(::_get_osfhandle(opened.claim.descriptor()));
  if (::LockFileEx(handle, how, 0, 1, 0, &place)) return opened;
  return {{}, last_error()};
}

}  // namespace

Claim claim_on(const fs::path& path) {
  const DWORD found = ::GetFileAttributesW(path.c_str());
  if (found == INVALID_FILE_ATTRIBUTES || (found & FILE_ATTRIBUTE_REPARSE_POINT) != 0) return {};
  if ((found & FILE_ATTRIBUTE_DIRECTORY) != 0) return opened_folder(path).claim;
  return locked(opened_file(path, OPEN_EXISTING), IfHeld::fail).claim;
}

Claim wait_for_folder(const fs::path& path) {
  constexpr int pause = 20;
  for (;;) {
    Claiming claiming = opened_folder(path.empty() ? fs::path(".") : path);
    if (claiming.failed != EWOULDBLOCK) return std::move(claiming.claim);
    pause_ms(pause);
  }
}

Claiming claim_on_mark(const fs::path& path, IfHeld if_held) {
  Claiming mark;
  // One that somebody removes stands in the way as long as another one has it open.
  mark.failed = patiently([&] { return (mark = opened_file(path, OPEN_ALWAYS)).failed; });
  return locked(std::move(mark), if_held);
}

Claiming make_claimed_file(const fs::path& path) { return locked(opened_file(path, CREATE_NEW), IfHeld::fail); }

Claiming make_claimed_folder(const fs::path& path) {
  if (!::CreateDirectoryW(path.c_str(), nullptr)) return {{}, last_error()};
  Claiming made = opened_folder(path);
  if (made.failed == ENOENT) made.failed = EWOULDBLOCK;  // removed as a left-over before it could be opened
  return made;
}

}  // namespace rheocyte

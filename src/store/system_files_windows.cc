#include <fcntl.h>
#include <io.h>
#include <windows.h>

#include <algorithm>
#include <cerrno>
#include <utility>

#include "store/scratch.h"
#include "store/system_files.h"
#include "store/windows_errors.h"

namespace rheocyte {

namespace fs = std::filesystem;

namespace {

constexpr DWORD fraction_all = FILE_SHARE_READ | FILE_SHARE_WRITE | FILE_SHARE_DELETE;

/// Also of folders, for which Windows wants its own flag.
class OpenHandle {
 public:
  OpenHandle(const fs::path& path, DWORD access, DWORD how, DWORD flags = 0)
      : handle_(::CreateFileW(path.c_str(), access, fraction_all, nullptr, how, FILE_FLAG_BACKUP_SEMANTICS | flags,
                              nullptr)),
        failed_(handle_ == INVALID_HANDLE_VALUE ? last_error() : 0) {}
  ~OpenHandle() {
    if (handle_ != INVALID_HANDLE_VALUE) ::CloseHandle(handle_);
  }
  OpenHandle(const OpenHandle&) = delete;
  OpenHandle& operator=(const OpenHandle&) = delete;

  HANDLE get() const { return handle_; }
  int failed() const { return failed_; }
  OpenFile as_file() {
    if (failed_) return {{}, failed_};
    const int descriptor = ::_open_osfhandle(reinterpret_cast<std::intptr_t>(handle_), _O_BINARY | _O_NOINHERIT);
    if (descriptor < 0) return {{}, EMFILE};
    handle_ = INVALID_HANDLE_VALUE;
    return {Claim(descriptor)};
  }

 private:
  HANDLE handle_;
  int failed_;
};

std::int64_t nanoseconds(LARGE_INTEGER time) { return time.QuadPart * 100; }

std::optional<FileFacts> facts_from(HANDLE handle) {
  if (::GetFileType(handle) != FILE_TYPE_DISK) return FileFacts{};
  BY_HANDLE_FILE_INFORMATION found{};
  FILE_BASIC_INFO times{};
  if (!::GetFileInformationByHandle(handle, &found) ||
      !::GetFileInformationByHandleEx(handle, FileBasicInfo, &times, sizeof times))
    return std::nullopt;
  const bool is_folder = (found.dwFileAttributes & FILE_ATTRIBUTE_DIRECTORY) != 0;
  return FileFacts{.is_file = !is_folder,
                   .is_folder = is_folder,
                   .device = found.dwVolumeSerialNumber,
                   .number = std::uint64_t{found.nFileIndexHigh} << 32U | found.nFileIndexLow,
                   .size = std::uint64_t{found.nFileSizeHigh} << 32U | found.nFileSizeLow,
                   .content_changed_ns = nanoseconds(times.LastWriteTime),
                   .entry_changed_ns = nanoseconds(times.ChangeTime)};
}

}  // namespace

const char* const nowhere = "NUL";

std::optional<FileFacts> facts_of(const fs::path& path, Links links) {
  const OpenHandle opened(path, FILE_READ_ATTRIBUTES, OPEN_EXISTING,
                          links == Links::look_at ? FILE_FLAG_OPEN_REPARSE_POINT : 0);
  return opened.failed() ? std::nullopt : facts_from(opened.get());
}

OpenFile open_to_read(const fs::path& path) {
  OpenHandle opened(path, GENERIC_READ, OPEN_EXISTING);
  if (opened.failed()) return {{}, opened.failed()};
  const auto facts = facts_from(opened.get());
  if (!facts) return {{}, last_error()};
  OpenFile file = opened.as_file();
  file.facts = *facts;
  return file;
}

OpenFile open_to_write(const fs::path& path) {
  return OpenHandle(path, GENERIC_WRITE, CREATE_ALWAYS, FILE_FLAG_OPEN_REPARSE_POINT).as_file();
}

int write_all(const Claim& file, std::string_view content) {
  constexpr std::size_t most = std::size_t{1} << 24U;
  const auto handle = reinterpret_cast<HANDLE>(::_get_osfhandle(file.descriptor()));
  while (!content.empty()) {
    DWORD written = 0;
    const auto wanted = static_cast<DWORD>(std::min(most, content.size()));
    if (!::WriteFile(handle, content.data(), wanted, &written, nullptr)) return last_error();
    content.remove_prefix(written);
  }
  return 0;
}

std::FILE* open_stream(const fs::path& path) { return ::_wfopen(path.c_str(), L"wbN"); }

void link_file(const fs::path& there, const fs::path& name) { ::CreateHardLinkW(name.c_str(), there.c_str(), nullptr); }

/// Of folders the journal of the file system takes care.
int bring_to_disk(const fs::path& path) {
  std::error_code error;
  if (fs::is_directory(path, error)) return 0;
  const OpenHandle opened(path, GENERIC_WRITE, OPEN_EXISTING);
  if (opened.failed()) return opened.failed();
  return ::FlushFileBuffers(opened.get()) ? 0 : last_error();
}

/// Rights are lists of whom they are given to: trying shows it.
int check_writable(const fs::path& folder) {
  const Scratch tried = new_scratch_file(folder / "rheocyte");
  remove_scratch(tried);
  return tried.failed;
}

/// Locks end with the machine, whose name and number need not change when it is started again.
std::string identity_of_machine() {
  wchar_t number[64] = L"";
  DWORD bytes = sizeof number;
  ::RegGetValueW(HKEY_LOCAL_MACHINE, L"SOFTWARE\\Microsoft\\Cryptography", L"MachineGuid", RRF_RT_REG_SZ, nullptr,
                 number, &bytes);
  wchar_t name[256] = L"";
  DWORD length = 256;
  ::GetComputerNameExW(ComputerNameDnsFullyQualified, name, &length);
  return narrow(name) + narrow(number);
}

}  // namespace rheocyte

#include "store/system_files.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>

#include "store/read_file.h"

namespace rheocyte {

namespace fs = std::filesystem;

namespace {

std::int64_t nanoseconds(const timespec& time) {
  return std::int64_t{time.tv_sec} * 1'000'000'000 + std::int64_t{time.tv_nsec};
}

FileFacts facts_from(const struct stat& found) {
  return {.is_file = S_ISREG(found.st_mode),
          .is_folder = S_ISDIR(found.st_mode),
          .device = static_cast<std::uint64_t>(found.st_dev),
          .number = static_cast<std::uint64_t>(found.st_ino),
          .size = static_cast<std::uint64_t>(found.st_size),
          .content_changed_ns = nanoseconds(found.st_mtim),
          .entry_changed_ns = nanoseconds(found.st_ctim)};
}

}  // namespace

const char* const nowhere = "/dev/null";

std::optional<FileFacts> facts_of(const fs::path& path, Links links) {
  struct stat found {};
  const int failed = links == Links::follow ? ::stat(path.c_str(), &found) : ::lstat(path.c_str(), &found);
  if (failed) return std::nullopt;
  return facts_from(found);
}

OpenFile open_to_read(const fs::path& path) {
  OpenFile opened{Claim(::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC))};
  struct stat found {};
  if (!opened.file || ::fstat(opened.file.descriptor(), &found) != 0) return {{}, errno};
  opened.facts = facts_from(found);
  return opened;
}

OpenFile open_to_write(const fs::path& path) {
  OpenFile opened{Claim(::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_NOFOLLOW | O_CLOEXEC, 0666))};
  if (!opened.file) opened.failed = errno;
  return opened;
}

int write_all(const Claim& file, std::string_view content) {
  std::signal(SIGXFSZ, SIG_IGN);
  while (!content.empty()) {
    const auto written = ::write(file.descriptor(), content.data(), content.size());
    if (written < 0 && errno != EINTR) return errno;
    if (written > 0) content.remove_prefix(static_cast<std::size_t>(written));
  }
  return 0;
}

std::FILE* open_stream(const fs::path& path) { return std::fopen(path.c_str(), "wbe"); }

void link_file(const fs::path& there, const fs::path& name) { static_cast<void>(!::link(there.c_str(), name.c_str())); }

int bring_to_disk(const fs::path& path) {
  const Claim open(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  if (!open) return errno;
  // Some file systems know no fsync; that is no loss of data.
  return ::fsync(open.descriptor()) == 0 || errno == EINVAL ? 0 : errno;
}

int check_writable(const fs::path& folder) { return ::access(folder.c_str(), W_OK | X_OK) == 0 ? 0 : errno; }

std::string identity_of_machine() {
  std::string name(256, '\0');
  ::gethostname(name.data(), name.size() - 1);
  return name + first_bytes("/proc/sys/kernel/random/boot_id", 64).value_or("");
}

}  // namespace rheocyte

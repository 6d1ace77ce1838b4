#include "store/read_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <system_error>

#include "case/refuse_path.h"
#include "store/claim.h"

namespace rheocyte {

namespace {

struct Opened {
  Claim file;
  std::size_t size = 0;
  int failed = 0;  ///< errno
  bool is_regular = true;
};

/// Opening never waits, as it would for a pipe to which nobody writes.
Opened open_regular(const std::filesystem::path& path) {
  Opened opened{Claim(::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC))};
  struct stat found {};
  if (!opened.file || ::fstat(opened.file.descriptor(), &found) != 0) return {{}, 0, errno};
  opened.is_regular = S_ISREG(found.st_mode);
  opened.size = static_cast<std::size_t>(found.st_size);
  return opened;
}

/// Fewer bytes at the end of the file; nothing if reading fails, see errno.
std::optional<std::string> read_some(const Opened& opened, std::size_t most) {
  std::string bytes(std::min(most, opened.size), '\0');
  std::size_t count = 0;
  while (count < bytes.size()) {
    const ssize_t n = ::read(opened.file.descriptor(), bytes.data() + count, bytes.size() - count);
    if (n < 0 && errno != EINTR) return std::nullopt;
    if (n == 0) break;
    if (n > 0) count += static_cast<std::size_t>(n);
  }
  bytes.resize(count);
  return bytes;
}

}  // namespace

std::optional<std::string> first_bytes(const std::filesystem::path& path, std::size_t most) {
  const Opened opened = open_regular(path);
  if (!opened.file || !opened.is_regular) return std::nullopt;
  return read_some(opened, most);
}

std::string content_of_file(const std::filesystem::path& path, std::size_t most) {
  const auto refuse_with = [&](int reason) {
    refuse_path(path, fmt::format("cannot be read ({}).", std::generic_category().message(reason)));
  };
  const Opened opened = open_regular(path);
  if (opened.failed) refuse_with(opened.failed);
  if (!opened.is_regular) refuse_path(path, "is not a regular file.");
  if (opened.size > most)
    refuse_path(path, fmt::format("is larger than the {} MB that such a file has at most.", most >> 20U));
  auto bytes = read_some(opened, most);
  if (!bytes) refuse_with(errno);
  return *std::move(bytes);
}

}  // namespace rheocyte

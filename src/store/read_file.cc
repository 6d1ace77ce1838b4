#include "store/read_file.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <system_error>

#include "case/refuse_path.h"
#include "store/system_files.h"
#include "store/system_limit.h"

namespace rheocyte {

namespace {

/// Fewer bytes at the end of the file; nothing if reading fails, see errno.
std::optional<std::string> read_some(const OpenFile& opened, std::size_t most) {
  std::string bytes(std::min<std::size_t>(most, opened.facts.size), '\0');
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
  const OpenFile opened = open_to_read(path);
  check_open_files(opened.failed);
  if (!opened.facts.is_file) return std::nullopt;
  return read_some(opened, most);
}

std::string content_of_file(const std::filesystem::path& path, std::size_t most) {
  const auto refuse_with = [&](int reason) {
    refuse_path(path, fmt::format("cannot be read ({}).", std::generic_category().message(reason)));
  };
  const OpenFile opened = open_to_read(path);
  check_open_files(opened.failed);
  if (opened.failed) refuse_with(opened.failed);
  if (!opened.facts.is_file) refuse_path(path, "is not a regular file.");
  if (opened.facts.size > most)
    refuse_path(path, fmt::format("is larger than the {} MB that such a file has at most.", most >> 20U));
  auto bytes = read_some(opened, most);
  if (!bytes) refuse_with(errno);
  return *std::move(bytes);
}

}  // namespace rheocyte

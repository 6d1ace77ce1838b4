#include "store/whole_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <random>
#include <string>
#include <system_error>
#include <utility>

#include "case/user_error.h"

namespace rheocyte {

namespace fs = std::filesystem;

namespace {

constexpr std::string_view infix = ".rheocyte-";
constexpr std::size_t random_digits = 12;

// 0, or the number of the error.
int write_all(int descriptor, std::string_view content) {
  while (!content.empty()) {
    const auto written = ::write(descriptor, content.data(), content.size());
    if (written < 0 && errno != EINTR) return errno;
    if (written > 0) content.remove_prefix(static_cast<std::size_t>(written));
  }
  return 0;
}

// Makes the file, and nothing if anybody else has made it or put a link in its place.
int write_new(const fs::path& file, std::string_view content, int flags) {
  std::signal(SIGXFSZ, SIG_IGN);  // a quota or limit then is an error of write() like a full disk
  const int descriptor = ::open(file.c_str(), O_WRONLY | O_CREAT | O_NOFOLLOW | O_CLOEXEC | flags, 0666);
  if (descriptor < 0) return errno;
  int failed = write_all(descriptor, content);
  if (::close(descriptor) != 0 && !failed) failed = errno;
  return failed;
}

int put_in_place(const fs::path& scratch, const fs::path& wanted) {
  int failed = bring_to_disk(scratch);
  if (!failed && ::rename(scratch.c_str(), wanted.c_str()) != 0) failed = errno;
  if (failed) return failed;
  bring_to_disk(wanted.has_parent_path() ? wanted.parent_path() : ".");  // it is in its place already
  return 0;
}

[[noreturn]] void refuse(const fs::path& path, const char* what, int reason) {
  throw UserError(
      fmt::format("{}: {} ({}).", one_line(path.string(), 300), what, std::generic_category().message(reason)));
}

}  // namespace

fs::path scratch_beside(const fs::path& wanted) {
  std::random_device random;  // the system's, not a series from a seed
  const auto number = std::uint64_t{random()} << 32U | random();
  return wanted.parent_path() /
         fmt::format(".{:.200}{}{:0{}x}", wanted.filename().string(), infix, number & 0xffff'ffff'ffffU, random_digits);
}

fs::path place_of(const fs::path& scratch) {
  const std::string name = scratch.filename().string();
  const auto end = name.rfind(infix);
  const bool hidden = name.starts_with('.') && end != std::string::npos && end > 0 &&
                      name.size() == end + infix.size() + random_digits &&
                      name.find_first_not_of("0123456789abcdef", end + infix.size()) == std::string::npos;
  return hidden ? scratch.parent_path() / name.substr(1, end - 1) : scratch;
}

int bring_to_disk(const fs::path& path) {
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) return errno;
  // Some file systems know no fsync; that is no loss of data.
  const int failed = ::fsync(descriptor) == 0 || errno == EINVAL ? 0 : errno;
  ::close(descriptor);
  return failed;
}

int write_part(const fs::path& file, std::string_view content) { return write_new(file, content, O_TRUNC); }

int write_whole_file(const fs::path& wanted, std::string_view content) {
  const fs::path scratch = scratch_beside(wanted);
  int failed = write_new(scratch, content, O_EXCL);
  if (failed == EEXIST) return failed;
  if (!failed) failed = put_in_place(scratch, wanted);
  if (failed) ::unlink(scratch.c_str());
  return failed;
}

WholeFile::WholeFile(const fs::path& wanted) : wanted_(wanted), scratch_(scratch_beside(wanted)) {
  if (const int failed = write_new(scratch_, {}, O_EXCL)) refuse(wanted_, "the file cannot be written", failed);
}

WholeFile::WholeFile(WholeFile&& other) noexcept
    : wanted_(std::move(other.wanted_)), scratch_(std::exchange(other.scratch_, {})) {}

WholeFile::~WholeFile() {
  if (!scratch_.empty()) ::unlink(scratch_.c_str());
}

void WholeFile::publish() {
  if (const int failed = put_in_place(scratch_, wanted_)) refuse(wanted_, "cannot be put in its place", failed);
  scratch_.clear();
}

}  // namespace rheocyte

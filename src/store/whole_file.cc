#include "store/whole_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <string>
#include <system_error>
#include <utility>

#include "case/refuse_path.h"
#include "store/renames.h"

namespace rheocyte {

namespace fs = std::filesystem;

namespace {

// 0, or the number of the error.
int write_all(int descriptor, std::string_view content) {
  std::signal(SIGXFSZ, SIG_IGN);  // a quota or limit then is an error of write() like a full disk
  while (!content.empty()) {
    const auto written = ::write(descriptor, content.data(), content.size());
    if (written < 0 && errno != EINTR) return errno;
    if (written > 0) content.remove_prefix(static_cast<std::size_t>(written));
  }
  return 0;
}

int move(const fs::path& from, const fs::path& to, Older older) {
  if (older == Older::keep)  // which some file systems do not know
    if (const int failed = rename_to_new(from, to); failed != EINVAL) return failed;
  return ::rename(from.c_str(), to.c_str()) == 0 ? 0 : errno;
}

[[noreturn]] void refuse(const fs::path& path, const char* what, int reason) {
  refuse_path(path, fmt::format("{} ({}).", what, std::generic_category().message(reason)));
}

}  // namespace

int publish_file(const fs::path& scratch, const fs::path& wanted, Older older) {
  int failed = bring_to_disk(scratch);
  if (!failed) failed = move(scratch, wanted, older);
  if (failed) return failed;
  bring_to_disk(wanted.has_parent_path() ? wanted.parent_path() : ".");  // it is in its place already
  return 0;
}

int bring_to_disk(const fs::path& path) {
  const Claim open(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  if (!open) return errno;
  // Some file systems know no fsync; that is no loss of data.
  return ::fsync(open.descriptor()) == 0 || errno == EINVAL ? 0 : errno;
}

int write_part(const fs::path& file, std::string_view content) {
  const int descriptor = ::open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_NOFOLLOW | O_CLOEXEC, 0666);
  if (descriptor < 0) return errno;
  int failed = write_all(descriptor, content);
  if (::close(descriptor) != 0 && !failed) failed = errno;
  return failed;
}

int write_whole_file(const fs::path& wanted, std::string_view content) {
  const Scratch scratch = new_scratch_file(wanted);
  if (scratch.failed) return scratch.failed;
  int failed = write_all(scratch.claim.descriptor(), content);
  if (!failed) failed = publish_file(scratch.path, wanted, Older::replace);
  if (failed) ::unlink(scratch.path.c_str());
  return failed;
}

WholeFile::WholeFile(const fs::path& wanted, std::function<void()> check) : wanted_(wanted), check_(std::move(check)) {
  this->check();
  scratch_ = new_scratch_file(wanted_);
  if (scratch_.failed) refuse(wanted_, "the file cannot be written", scratch_.failed);
}

WholeFile::~WholeFile() {
  if (scratch_.claim) ::unlink(scratch_.path.c_str());
}

void WholeFile::check() const {
  if (check_) check_();
}

void WholeFile::publish() {
  std::error_code error;
  const bool is_new = !fs::exists(fs::symlink_status(wanted_, error));
  check();  // the world may have changed while the file was written
  if (const int failed = publish_file(scratch_.path, wanted_, is_new && check_ ? Older::keep : Older::replace))
    refuse(wanted_, "cannot be put in its place", failed);
  scratch_ = {};
}

}  // namespace rheocyte

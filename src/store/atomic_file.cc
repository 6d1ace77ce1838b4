#include "store/atomic_file.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstdio>
#include <string>
#include <system_error>
#include <utility>

#include "case/refuse_path.h"
#include "store/renames.h"
#include "store/system_files.h"

namespace rheocyte {

namespace fs = std::filesystem;

namespace {

int move(const fs::path& from, const fs::path& to, Older older) {
  if (older == Older::keep)  // which some file systems do not know
    if (const int failed = rename_to_new(from, to); failed != EINVAL) return failed;
  return rename_over(from, to);
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

int write_part(const fs::path& file, std::string_view content) {
  OpenFile opened = open_to_write(file);
  if (opened.failed) return opened.failed;
  const int failed = write_all(opened.file, content), not_closed = opened.file.close();
  return failed ? failed : not_closed;
}

int write_atomically(const fs::path& wanted, std::string_view content) {
  const Scratch scratch = new_scratch_file(wanted);
  if (scratch.failed) return scratch.failed;
  int failed = write_all(scratch.claim, content);
  if (!failed) failed = publish_file(scratch.path, wanted, Older::replace);
  if (failed) remove_scratch(scratch);
  return failed;
}

AtomicFile::AtomicFile(const fs::path& wanted, std::function<void()> check)
    : wanted_(wanted), check_(std::move(check)) {
  this->check();
  scratch_ = new_scratch_file(wanted_);
  if (scratch_.failed) refuse(wanted_, "the file cannot be written", scratch_.failed);
}

AtomicFile::~AtomicFile() {
  if (scratch_.claim) remove_scratch(scratch_);
}

void AtomicFile::check() const {
  if (check_) check_();
}

void AtomicFile::publish() {
  std::error_code error;
  const bool is_new = !fs::exists(fs::symlink_status(wanted_, error));
  check();  // the world may have changed while the file was written
  if (const int failed = publish_file(scratch_.path, wanted_, is_new && check_ ? Older::keep : Older::replace))
    refuse(wanted_, "cannot be put in its place", failed);
  scratch_ = {};
}

}  // namespace rheocyte

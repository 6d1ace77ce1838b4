#include "store/work_folder.h"

#include <fmt/format.h>

#include <cerrno>
#include <system_error>
#include <utility>

#include "case/refuse_path.h"
#include "case/to_path.h"
#include "store/atomic_file.h"
#include "store/read_file.h"
#include "store/scratch.h"

namespace rheocyte {

namespace fs = std::filesystem;

namespace {

constexpr const char* mark_file = "begun-by.txt";
constexpr const char* spec_file = "spec.toml";
constexpr const char* beginning = "begun-by.claim";  ///< its holder writes spec and mark

std::string words_for(int number) { return std::generic_category().message(number); }

std::string content_of(const fs::path& path) {
  constexpr std::size_t enough = std::size_t{1} << 30U;
  return first_bytes(path, enough).value_or("");
}

bool is_of_locks(int reason) {
  return reason == ENOLCK || reason == EOPNOTSUPP || reason == ENOSYS || reason == EINVAL;
}

// Nothing if another process holds it, unless that one is waited for.
Claim locked(const fs::path& path, IfHeld if_held) {
  Claiming claiming = claim_on_mark(path, if_held);
  if (is_of_locks(claiming.failed))
    refuse_path(path, fmt::format("cannot be locked ({}); put the table on a file system with locks, with -o.",
                                  words_for(claiming.failed)));
  if (claiming.failed && claiming.failed != EWOULDBLOCK)
    refuse_path(path, fmt::format("cannot be made ({}).", words_for(claiming.failed)));
  return std::move(claiming.claim);
}

void write_whole(const fs::path& path, std::string_view content) {
  if (const int failed = write_atomically(path, content))
    refuse_path(path,
                fmt::format("cannot be written ({}); what is finished is kept, start again with the same command.",
                            words_for(failed)));
}

std::string_view first_line(std::string_view text) { return text.substr(0, text.find('\n')); }

}  // namespace

WorkFolder::WorkFolder(fs::path folder, WantedWork wanted) : folder_(std::move(folder)), wanted_(std::move(wanted)) {
  begin();
}

bool WorkFolder::is_begun() const {
  std::error_code error;
  if (!fs::exists(folder_ / mark_file, error)) return false;
  const std::string found = content_of(folder_ / mark_file);
  if (found == wanted_.mark || (!found.empty() && found == wanted_.earlier_mark)) return true;
  refuse_path(folder_, fmt::format("contains a table that was begun as \"{}\", not as \"{}\"; give another folder with "
                                   "-o, or the spec and program of the first start.",
                                   first_line(found), first_line(wanted_.mark)));
}

bool WorkFolder::holds_the_spec() const { return content_of(folder_ / spec_file) == wanted_.spec; }

void WorkFolder::begin() const {
  if (is_begun()) return;
  std::error_code error, ignored;
  fs::create_directories(folder_, error);
  if (error && !fs::exists(folder_, ignored))
    refuse_path(folder_, fmt::format("cannot be made ({}).", error.message()));
  const bool has_files = !fs::is_directory(folder_, ignored) || !fs::is_empty(folder_, ignored);
  // With the claim beside them they are ours: of a process that begins at this moment, or was lost on the way.
  if (has_files && !fs::exists(folder_ / beginning, ignored) && !holds_the_spec())
    refuse_path(folder_, "contains other files; give a new or empty folder with -o.");
  const Claim alone = locked(folder_ / beginning, IfHeld::wait);
  if (is_begun()) return;
  fs::create_directories(pieces(), error);
  if (error) refuse_path(folder_, fmt::format("cannot be made ({}).", error.message()));
  write_whole(folder_ / spec_file, wanted_.spec);
  write_whole(folder_ / mark_file, wanted_.mark);
}

Claim WorkFolder::claim(const std::string& piece) const { return locked(record(piece + ".claim"), IfHeld::fail); }

bool WorkFolder::has(const std::string& name) const {
  std::error_code error;
  return fs::exists(record(name), error);
}

std::string WorkFolder::content(const std::string& name) const { return content_of(record(name)); }

void WorkFolder::keep(const std::string& name, std::string_view content) const { write_whole(record(name), content); }

void WorkFolder::take_over() const {
  if (content_of(folder_ / mark_file) != wanted_.mark) write_whole(folder_ / mark_file, wanted_.mark);
}

void WorkFolder::publish(const std::string& name, std::string_view content) const {
  write_whole(folder_ / to_path(name), content);
}

void WorkFolder::tidy() const {
  std::error_code error;
  for (const auto& place : {pieces(), folder_})
    for (const auto& entry : fs::directory_iterator(place, error))
      if (entry.path().extension() == ".claim") fs::remove(entry.path(), error);
  for (const auto& place : {pieces(), folder_}) remove_left_over_files(place);
}

}  // namespace rheocyte

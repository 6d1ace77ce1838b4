#include "store/result_folder.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <fstream>
#include <string_view>
#include <system_error>

#include "case/user_error.h"
#include "store/whole_file.h"

namespace rheocyte {

namespace fs = std::filesystem;

namespace {

constexpr std::array<std::string_view, 16> own_files{
    "result.json", "contour.csv",  "fields.vtu", "case.toml",  "picture.png",      "picture.svg",
    "history.csv", "contours.csv", "fields.pvd", "fields",     "checkpoint-1.bin", "checkpoint-2.bin",
    "time.png",    "time.svg",     "time.gif",   "channel.csv"};

[[noreturn]] void refuse(const fs::path& path, const std::string& reason) {
  throw UserError(fmt::format("{}: {}", path.string(), reason));
}

std::string reason_of(int error_number) { return std::generic_category().message(error_number); }

bool holds_a_result(const fs::path& folder) {
  std::ifstream file(folder / "result.json", std::ios::binary);
  std::string start(200, '\0');
  file.read(start.data(), static_cast<std::streamsize>(start.size()));
  return start.find("\"program\": \"rheocyte\"") != std::string::npos;
}

bool is_inside(const fs::path& path, const fs::path& folder) {
  return std::mismatch(folder.begin(), folder.end(), path.begin(), path.end()).first == folder.end();
}

// A folder can be replaced if it is empty or an older result, and is neither a mount point nor in use as the
// current folder (a shell standing in it would lose its ground).
void check_replaceable(const fs::path& folder) {
  std::error_code error;
  const auto status = fs::status(folder, error);
  if (status.type() == fs::file_type::not_found) return;
  if (error) refuse(folder, fmt::format("cannot write a result there ({}).", error.message()));
  if (!fs::is_directory(status)) refuse(folder, "is a file; give a folder for the result with -o.");
  const bool empty = fs::is_empty(folder, error);
  if (error) refuse(folder, fmt::format("cannot read the folder ({}).", error.message()));
  if (!empty && !holds_a_result(folder))
    refuse(folder, "holds files but no result of rheocyte; give a new or empty folder with -o.");
  if (is_inside(fs::current_path(error), folder))
    refuse(folder, "is the current folder or contains it; give another folder with -o.");
  struct stat here {
  }, above{};
  if (::stat(folder.c_str(), &here) == 0 && ::stat((folder / "..").c_str(), &above) == 0 && here.st_dev != above.st_dev)
    refuse(folder, "is a mount point and cannot be replaced as a whole; give a folder inside it with -o.");
}

fs::path resolved(const fs::path& folder) {
  std::error_code error;
  fs::path path = fs::weakly_canonical(fs::absolute(folder), error);
  if (error) refuse(folder, fmt::format("cannot write a result there ({}).", error.message()));
  if (!path.has_filename()) path = path.parent_path();  // a trailing slash
  if (!path.has_filename()) refuse(folder, "is no folder for a result; give another one with -o.");
  return path;
}

// Makes an empty sibling of the folder, on the same file system, so that a rename can swap them.
fs::path make_scratch(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder.parent_path(), error);
  if (error) refuse(folder, fmt::format("cannot make its parent folder ({}).", error.message()));
  const fs::path scratch = scratch_beside(folder);
  if (::mkdir(scratch.c_str(), 0700) != 0)
    refuse(folder, fmt::format("cannot write a result there ({}).", reason_of(errno)));
  ::chmod(scratch.c_str(), fs::exists(folder) ? 0777 & static_cast<mode_t>(fs::status(folder).permissions()) : 0755);
  return scratch;
}

void keep_on_disk(const fs::path& path) {
  if (const int failed = bring_to_disk(path)) refuse(path, fmt::format("cannot be written ({}).", reason_of(failed)));
}

// Afterwards `folder` is the new result and `scratch` holds the old one, if there was one.
void swap_in(const fs::path& scratch, const fs::path& folder) {
  const unsigned how = fs::exists(folder) ? RENAME_EXCHANGE : RENAME_NOREPLACE;
  if (::renameat2(AT_FDCWD, scratch.c_str(), AT_FDCWD, folder.c_str(), how) == 0) return;
  if (errno == EINVAL && !fs::exists(folder) && ::rename(scratch.c_str(), folder.c_str()) == 0) return;
  refuse(folder, fmt::format("cannot put the result in its place ({}).", reason_of(errno)));
}

// Whether all of them could be moved over.
bool keep_foreign_files(const fs::path& old_folder, const fs::path& folder) {
  std::error_code error;
  bool all_kept = true;
  for (const auto& entry : fs::directory_iterator(old_folder, error)) {
    const auto name = entry.path().filename();
    if (std::ranges::find(own_files, name.string()) != own_files.end()) continue;
    fs::rename(entry.path(), folder / name, error);
    all_kept = all_kept && !error;
  }
  return all_kept && !error;
}

}  // namespace

fs::path check_result_folder(const fs::path& folder) {
  const fs::path path = resolved(folder);
  check_replaceable(path);
  std::error_code ignored;
  fs::remove(make_scratch(path), ignored);
  return path;
}

ResultFolder::ResultFolder(const fs::path& folder) : folder_(resolved(folder)) {
  check_replaceable(folder_);
  scratch_ = make_scratch(folder_);
}

ResultFolder::~ResultFolder() {
  std::error_code ignored;
  if (!scratch_.empty()) fs::remove_all(scratch_, ignored);
}

void ResultFolder::write(const std::string& file_name, std::string_view content) const {
  if (const int failed = write_part(scratch_ / file_name, content))
    refuse(folder_,
           fmt::format("cannot write {} ({}); an older result is left as it was.", file_name, reason_of(failed)));
}

void ResultFolder::publish() {
  for (const auto& entry : fs::recursive_directory_iterator(scratch_))
    if (entry.is_regular_file()) keep_on_disk(entry.path());
  keep_on_disk(scratch_);
  check_replaceable(folder_);  // the world may have changed during the computation
  swap_in(scratch_, folder_);
  keep_on_disk(folder_.parent_path());
  // What cannot be moved stays in the old folder under its scratch name: better a left-over than a lost file.
  if (fs::exists(scratch_) && !keep_foreign_files(scratch_, folder_)) scratch_.clear();
}

}  // namespace rheocyte

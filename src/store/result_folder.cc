#include "store/result_folder.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <string_view>
#include <system_error>

#include "case/refuse_path.h"
#include "case/to_path.h"
#include "store/atomic_file.h"
#include "store/own_file.h"
#include "store/read_file.h"
#include "store/renames.h"
#include "store/system_files.h"
#include "store/user_files.h"

namespace rheocyte {

namespace fs = std::filesystem;

namespace {

constexpr std::array<std::string_view, 25> own_files{"result.json",
                                                     "contour.csv",
                                                     "fields.vtu",
                                                     "case.toml",
                                                     "picture.png",
                                                     "picture.svg",
                                                     "history.csv",
                                                     "contours.csv",
                                                     "fields.pvd",
                                                     "fields",
                                                     "checkpoint-1.bin",
                                                     "checkpoint-2.bin",
                                                     "time.png",
                                                     "time.svg",
                                                     "time.gif",
                                                     "channel.csv",
                                                     "outputs.csv",
                                                     "history_errors.csv",
                                                     "outputs_errors.csv",
                                                     "contours_across.csv",
                                                     "contours_offset.csv",
                                                     "contour_side.csv",
                                                     "contour_diagonal.csv",
                                                     "contour_across.csv",
                                                     "contour_offset.csv"};
constexpr std::array<const char*, 5> pictures{"picture.png", "picture.svg", "time.png", "time.svg", "time.gif"};
constexpr std::array<const char*, 2> checkpoints{"checkpoint-1.bin", "checkpoint-2.bin"};

std::string reason_of(int error_number) { return std::generic_category().message(error_number); }

bool holds_a_result(const fs::path& folder) {
  const std::string start = first_bytes(folder / "result.json", 200).value_or("");
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
  if (status.type() == fs::file_type::not_found) {
    if (fs::is_symlink(folder, error))
      refuse_path(folder, "is a link that leads nowhere; give another folder with -o.");
    return;
  }
  if (error) refuse_path(folder, fmt::format("cannot write a result there ({}).", error.message()));
  if (!fs::is_directory(status)) refuse_path(folder, "is a file; give a folder for the result with -o.");
  const bool empty = fs::is_empty(folder, error);
  if (error) refuse_path(folder, fmt::format("cannot read the folder ({}).", error.message()));
  if (!empty && !holds_a_result(folder))
    refuse_path(folder, "contains files but no result of rheocyte; give a new or empty folder with -o.");
  for (const char* const picture : pictures)
    check_replaceable_picture(folder / to_path(picture), "move it away, or give another folder with -o");
  if (is_inside(fs::current_path(error), folder))
    refuse_path(folder, "is the current folder or contains it; give another folder with -o.");
  const auto here = facts_of(folder, Links::follow), above = facts_of(folder / "..", Links::follow);
  if (here && above && here->device != above->device)
    refuse_path(folder, "is a mount point and cannot be replaced as a whole; give a folder inside it with -o.");
}

fs::path resolved(const fs::path& folder) {
  std::error_code error;
  fs::path path = fs::weakly_canonical(fs::absolute(folder), error);
  if (error) refuse_path(folder, fmt::format("cannot write a result there ({}).", error.message()));
  if (!path.has_filename()) path = path.parent_path();  // a trailing slash
  if (!path.has_filename()) refuse_path(folder, "cannot be a folder for a result; give another one with -o.");
  return path;
}

// Makes an empty sibling of the folder, on the same file system, so that a rename can swap them.
Scratch make_scratch(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder.parent_path(), error);
  if (error) refuse_path(folder, fmt::format("cannot make its parent folder ({}).", error.message()));
  Scratch scratch = new_scratch_folder(folder);
  if (scratch.failed) refuse_path(folder, fmt::format("cannot write a result there ({}).", reason_of(scratch.failed)));
  constexpr fs::perms usual{0755}, known{0777};
  fs::permissions(scratch.path, fs::exists(folder) ? fs::status(folder).permissions() & known : usual, error);
  return scratch;
}

void keep_on_disk(const fs::path& path) {
  if (const int failed = bring_to_disk(path))
    refuse_path(path, fmt::format("cannot be written ({}).", reason_of(failed)));
}

// Afterwards `folder` is the new result and `scratch` holds the old one, if there was one.
void swap_in(const fs::path& scratch, const fs::path& folder) {
  const int failed = fs::exists(folder) ? exchange_names(scratch, folder) : rename_to_new(scratch, folder);
  if (!failed || (failed == EINVAL && !fs::exists(folder) && rename_over(scratch, folder) == 0)) return;
  refuse_path(folder, fmt::format("cannot put the result in its place ({}).", reason_of(failed)));
}

bool has_checkpoints(const fs::path& folder) {
  std::error_code error;
  return std::ranges::any_of(checkpoints, [&](const char* name) { return fs::exists(folder / to_path(name), error); });
}

}  // namespace

fs::path check_result_folder(const fs::path& folder) {
  fs::path path = resolved(folder);
  check_replaceable(path);
  remove_scratch(make_scratch(path));
  return path;
}

std::vector<Scratch> interrupted_results(const fs::path& folder) {
  std::vector<Scratch> found = left_over_folders(resolved(folder));
  std::erase_if(found, [](const Scratch& scratch) { return !has_checkpoints(scratch.path); });
  return found;
}

ResultFolder::ResultFolder(const fs::path& folder) : folder_(resolved(folder)) {
  check_replaceable(folder_);
  for (const auto& scratch : left_over_folders(folder_))
    if (!has_checkpoints(scratch.path) && !has_user_files(scratch.path, own_files)) remove_scratch(scratch);
  scratch_ = make_scratch(folder_);
}

ResultFolder::~ResultFolder() { remove_scratch(scratch_); }

void ResultFolder::write(const std::string& file_name, std::string_view content) const {
  if (const int failed = write_part(scratch_.path / to_path(file_name), content))
    refuse_path(folder_,
                fmt::format("cannot write {} ({}); an older result is left as it was.", file_name, reason_of(failed)));
}

void ResultFolder::publish() {
  const fs::path& scratch = scratch_.path;
  for (const auto& entry : fs::recursive_directory_iterator(scratch))
    if (entry.is_regular_file()) keep_on_disk(entry.path());
  check_replaceable(folder_);  // the world may have changed during the computation
  // First of all, so that no moment exists in which they stand under the hidden name alone.
  link_user_files(folder_, scratch, own_files);
  keep_on_disk(scratch);
  const Claim old = claim_on(folder_);  // soon under the hidden name, but no left-over yet
  swap_in(scratch, folder_);
  keep_on_disk(folder_.parent_path());
  // What cannot be moved stays in the old folder under its scratch name: better a left-over than a lost file.
  if (!fs::exists(scratch) || move_user_files(scratch, folder_, own_files, Twice::moved_replaces))
    remove_scratch(scratch_);
  scratch_ = {};
  for (const auto& left_over : left_over_folders(folder_))
    if (move_user_files(left_over.path, folder_, own_files, Twice::both_stay)) remove_scratch(left_over);
}

}  // namespace rheocyte

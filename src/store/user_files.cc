#include "store/user_files.h"

#include <algorithm>
#include <string>
#include <system_error>
#include <vector>

#include "store/system_files.h"

namespace rheocyte {

namespace fs = std::filesystem;

namespace {

std::vector<fs::path> user_names(const fs::path& folder, OwnNames own) {
  std::vector<fs::path> names;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error))
    if (std::ranges::find(own, entry.path().filename().string()) == own.end()) names.push_back(entry.path().filename());
  return names;
}

bool is_folder(const fs::path& path) {
  std::error_code error;
  return fs::is_directory(fs::symlink_status(path, error));
}

// Two names of one file, or of one link.
bool is_same(const fs::path& one, const fs::path& other) {
  const auto a = facts_of(one, Links::look_at), b = facts_of(other, Links::look_at);
  return a && b && a->is_same_as(*b);
}

}  // namespace

bool has_user_files(const fs::path& folder, OwnNames own) { return !user_names(folder, own).empty(); }

void link_user_files(const fs::path& from, const fs::path& to, OwnNames own) {
  std::error_code error;
  for (const auto& name : user_names(from, own)) {
    if (!is_folder(from / name)) {
      link_file(from / name, to / name);
    } else if (fs::create_directory(to / name, from / name, error)) {
      link_user_files(from / name, to / name, {});
    }
  }
}

bool move_user_files(const fs::path& from, const fs::path& to, OwnNames own, Twice twice) {
  bool all = true;
  for (const auto& name : user_names(from, own)) {
    std::error_code error;
    const fs::path source = from / name, target = to / name;
    const auto there = fs::symlink_status(target, error);
    if (fs::exists(there) && is_folder(source) && fs::is_directory(there)) {
      all = move_user_files(source, target, {}, twice) && all;
    } else if (!fs::exists(there) || twice == Twice::moved_replaces) {
      fs::rename(source, target, error);  // of two links to one file both stay
      all = all && !error;
    } else {
      all = all && is_same(source, target);
    }
  }
  return all;
}

}  // namespace rheocyte

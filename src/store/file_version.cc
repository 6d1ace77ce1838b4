#include "store/file_version.h"

#include <fmt/format.h>
#include <sys/stat.h>

#include <algorithm>
#include <system_error>
#include <vector>

namespace rheocyte {

namespace {

namespace fs = std::filesystem;

std::string of_file(const struct stat& file) {
  const auto time = [](const timespec& at) { return fmt::format("{:x}.{:x}", at.tv_sec, at.tv_nsec); };
  return fmt::format("{:x}-{:x}-{:x}-{}-{};", file.st_dev, file.st_ino, file.st_size, time(file.st_mtim),
                     time(file.st_ctim));
}

}  // namespace

std::string file_version(const fs::path& place) {
  struct stat found {};
  if (::stat(place.c_str(), &found) != 0) return {};
  if (!S_ISDIR(found.st_mode)) return of_file(found);
  std::vector<std::string> entries;
  std::error_code error;
  for (auto at = fs::directory_iterator(place, error); !error && at != fs::end(at); at.increment(error))
    if (!at->is_directory(error)) entries.push_back(file_version(at->path()));
  std::ranges::sort(entries);
  std::string all;
  for (const auto& entry : entries) all += entry;
  return all;
}

std::string file_version(std::span<const fs::path> places) {
  std::string all;
  for (const auto& place : places) all += file_version(place);
  return all;
}

}  // namespace rheocyte

#include "store/file_version.h"

#include <fmt/format.h>

#include <algorithm>
#include <system_error>
#include <vector>

#include "store/system_files.h"

namespace rheocyte {

namespace {

namespace fs = std::filesystem;

std::string of_file(const FileFacts& file) {
  return fmt::format("{:x}-{:x}-{:x}-{:x}-{:x};", file.device, file.number, file.size, file.content_changed_ns,
                     file.entry_changed_ns);
}

}  // namespace

std::string file_version(const fs::path& place) {
  const auto found = facts_of(place, Links::follow);
  if (!found) return {};
  if (!found->is_folder) return of_file(*found);
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

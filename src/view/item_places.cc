#include "view/item_places.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <system_error>

#include "case/user_error.h"
#include "events/recording_list.h"

namespace rheocyte {

namespace {

namespace fs = std::filesystem;

/// The table as one file, or in its folder the text.
bool is_combined(const fs::path& file) {
  const fs::path ending = file.extension();
  return (ending == ".cbor" || ending == ".csv") && file.filename().string().starts_with("combined_");
}

ItemKind kind_of_file(const fs::path& file) {
  const fs::path ending = file.extension();
  if (ending == ".toml") return ItemKind::case_file;
  if (ending == ".cbor" && is_combined(file)) return ItemKind::combined;
  return ending == ".cbor" || ending == ".txt" ? ItemKind::table : ItemKind::recording;
}

bool is_grid(const fs::path& file) {
  return file.extension() == ".cbor" && file.filename().string().starts_with("grid_");
}

std::vector<fs::path> entries_of(const fs::path& folder, std::error_code& error) {
  std::vector<fs::path> entries;
  for (auto at = fs::directory_iterator(folder, error); !error && at != fs::end(at); at.increment(error))
    if (!at->path().filename().string().starts_with('.')) entries.push_back(at->path());
  std::ranges::sort(entries);
  return entries;
}

void search(const fs::path& folder, Folders folders, std::vector<ItemPlace>& found) {
  std::error_code error;
  if (fs::is_regular_file(folder / "result.json", error)) {
    found.push_back({ItemKind::result, folder});
    return;
  }
  const std::vector<fs::path> entries = entries_of(folder, error);
  if (std::ranges::any_of(entries, is_grid)) {
    found.push_back({ItemKind::table, folder});
    return;
  }
  if (std::ranges::any_of(entries, is_combined)) {
    found.push_back({ItemKind::combined, folder});
    return;
  }
  if (folders == Folders::as_they_are) return;
  for (const auto& entry : entries) {
    // A link to a folder may lead round in a circle.
    if (fs::is_directory(entry, error) && !fs::is_symlink(entry, error))
      search(entry, folders, found);
    else if (entry.extension() == ".rtdc" && fs::is_regular_file(entry, error))
      found.push_back({ItemKind::recording, entry});
  }
}

void drop_companions(std::vector<ItemPlace>& found) {
  std::vector<fs::path> recordings;
  for (const auto& place : found)
    if (place.kind == ItemKind::recording) recordings.push_back(place.path);
  const auto kept = without_companions_of_others(recordings);
  const std::set<fs::path> wanted(kept.begin(), kept.end());
  std::erase_if(
      found, [&](const ItemPlace& place) { return place.kind == ItemKind::recording && !wanted.contains(place.path); });
}

std::vector<ItemPlace> places_of(const fs::path& path, Folders folders) {
  std::error_code error;
  const std::string name = path.filename().string(), whole = one_line(path.string(), 300);
  if (!fs::exists(path, error))
    return {{kind_of_file(path), path, name, fmt::format("{}: there is no such file.", whole)}};
  if (!fs::is_directory(path, error)) return {{kind_of_file(path), path, name}};
  std::vector<ItemPlace> found;
  search(path, folders, found);
  drop_companions(found);
  if (found.empty())
    return {{ItemKind::recording, path, name,
             fmt::format("{}: this folder contains no recording (.rtdc), no result and no table, or it cannot be read.",
                         whole)}};
  for (auto& place : found) place.name = place.path == path ? name : place.path.lexically_relative(path).string();
  return found;
}

}  // namespace

std::string_view name_of(ItemKind kind) {
  switch (kind) {
    case ItemKind::case_file: return "case";
    case ItemKind::result: return "result";
    case ItemKind::table: return "table";
    case ItemKind::combined: return "combined";
    default: return "recording";
  }
}

std::vector<ItemPlace> item_places(std::span<const fs::path> paths, Folders folders) {
  std::vector<ItemPlace> places;
  std::set<fs::path> seen;
  for (const auto& path : paths)
    for (auto& place : places_of((fs::absolute(path) / "").lexically_normal().parent_path(), folders))
      if (seen.insert(place.path).second) places.push_back(std::move(place));
  return places;
}

}  // namespace rheocyte

#include "view/view_items.h"

#include <algorithm>
#include <array>
#include <system_error>

#include "case/json_guard.h"
#include "case/to_path.h"
#include "case/user_error.h"
#include "serve/http.h"
#include "shelf/modulus_tables.h"
#include "store/file_version.h"
#include "view/item_work.h"
#include "view/path_text.h"

namespace rheocyte {

namespace {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

constexpr std::size_t longest_label = 200;
constexpr std::array names_of_states{"loading", "ready", "failed"};

std::string label_in(const Json& labels, const char* name, const std::string& before) {
  if (!labels.contains(name)) return before;
  if (!labels[name].is_string()) throw Refused(400, "input", std::string(name) + " is not a text.");
  return one_line(labels[name].get<std::string>(), longest_label);
}

/// The files of basins are for us, not for the page.
void take_basins(ViewItems::Item& item) {
  if (!item.description.contains("basins")) return;
  for (const Json& file : item.description["basins"]) {
    item.files.push_back(to_path(file.get<std::string>()));
    item.version += file_version(item.files.back());
  }
  item.description.erase("basins");
}

ViewItems::Item new_item(ItemPlace place) {
  ViewItems::Item item{std::move(place)};
  item.files = {item.place.kind == ItemKind::result ? item.place.path / "result.json" : item.place.path};
  if (item.place.error.empty()) return item;
  item.state = ViewItems::State::failed;
  item.error = item.place.error;
  return item;
}

}  // namespace

ViewItems::ViewItems(std::span<const fs::path> paths) : host_(do_item_work) {
  for (auto& place : item_places(paths)) items_.push_back(new_item(std::move(place)));
  if (has_threads) reader_ = Thread([this](const std::stop_token& stop) { describe_all(stop); }, small_stack);
  look_for_added();
}

ViewItems::~ViewItems() = default;

void ViewItems::describe_all(const std::stop_token& stop) {
  while (!stop.stop_requested()) {
    if (describe_next(stop)) continue;
    std::unique_lock lock(mutex_);
    added_.wait(lock, stop, [this] { return std::ranges::count(items_, State::loading, &Item::state) > 0; });
  }
}

/// False if there is none that waits for it.
bool ViewItems::describe_next(const std::stop_token& stop) {
  std::size_t next = 0;
  {
    const std::scoped_lock lock(mutex_);
    const auto found = std::ranges::find(items_, State::loading, &Item::state);
    if (found == items_.end()) return false;
    next = static_cast<std::size_t>(found - items_.begin());
  }
  describe(next, stop);
  return true;
}

/// Without a thread that waits for them they are described here.
void ViewItems::look_for_added() {
  added_.notify_all();
  while (!has_threads && describe_next({})) {
  }
}

void ViewItems::describe(std::size_t number, const std::stop_token& stop) {
  Item item = at(number);
  const ItemPlace& place = item.place;
  item.state = State::ready;
  item.error.clear();
  item.files.resize(1);
  item.version = file_version(item.files);  // before it is read
  try {
    const Json request{{"do", "describe"}, {"kind", name_of(place.kind)}, {"file", path_text(place.path)}};
    HostedWork work = host_.ask(json_text(request));
    item.description = parse_sound_json(work.all({.stop = [&stop] { return stop.stop_requested(); }}));
    take_basins(item);
  } catch (const UserError& reason) {
    item.state = State::failed;
    item.error = reason.what();
    item.description = Json();
  }
  const std::scoped_lock lock(mutex_);
  item.condition = items_[number].condition;  // may have been named meanwhile
  item.replicate = items_[number].replicate;
  items_[number] = std::move(item);
}

void ViewItems::look_after(std::size_t number) {
  const Item before = at(number);
  std::error_code error;
  const bool is_there = fs::exists(before.place.path, error);
  const std::string version = file_version(before.files);
  const std::scoped_lock lock(mutex_);
  Item& item = items_[number];
  if (!item.place.error.empty() || item.state == State::loading || item.files != before.files) return;
  const std::string vanished = one_line(item.place.path.string(), 300) + ": is no longer there.";
  if (!is_there) {
    item.state = State::failed;
    item.error = vanished;
  } else if (item.error == vanished || item.version != version) {
    item.state = State::loading;
  }
}

std::size_t ViewItems::count() const {
  const std::scoped_lock lock(mutex_);
  return items_.size();
}

std::vector<std::string> ViewItems::missing() const {
  const std::scoped_lock lock(mutex_);
  std::vector<std::string> sentences;
  for (const Item& item : items_)
    if (!item.place.error.empty()) sentences.push_back(item.place.error);
  return sentences;
}

Json ViewItems::list() {
  Json all = Json::array();
  for (std::size_t number = 0; number < count(); ++number) look_after(number);
  look_for_added();
  for (std::size_t number = 0; number < count(); ++number) all.push_back(summary_of(number, at(number)));
  return all;
}

ViewItems::Item ViewItems::at(std::size_t number) const {
  const std::scoped_lock lock(mutex_);
  if (number >= items_.size()) throw Refused(404, "unknown", "There is no item of this number.");
  return items_[number];
}

ViewItems::Item ViewItems::recording(std::size_t number) const {
  Item item = at(number);
  if (item.place.kind != ItemKind::recording) throw Refused(409, "kind", "This item is not a recording.");
  if (!item.place.error.empty()) throw UserError(item.place.error);
  return item;
}

fs::path ViewItems::table(std::size_t number) const {
  const Item item = at(number);
  if (item.place.kind != ItemKind::table || !item.place.error.empty())
    throw UserError("The setting table names an item that is not a table.");
  return item.place.path;
}

fs::path ViewItems::combined() const {
  const std::scoped_lock lock(mutex_);
  const auto found = std::ranges::find_if(
      items_, [](const Item& item) { return item.place.kind == ItemKind::combined && item.state == State::ready; });
  return found == items_.end() ? fs::path() : found->place.path;
}

void ViewItems::label(std::size_t number, const Json& labels) {
  const Item before = at(number);
  const std::string condition = label_in(labels, "condition", before.condition),
                    replicate = label_in(labels, "replicate", before.replicate);
  const std::scoped_lock lock(mutex_);
  items_[number].condition = condition;
  items_[number].replicate = replicate;
}

Json ViewItems::kept() const {
  const std::scoped_lock lock(mutex_);
  Json all = Json::array();
  for (const Item& item : items_)
    all.push_back({{"path", path_text(item.place.path)}, {"condition", item.condition}, {"replicate", item.replicate}});
  return all;
}

void ViewItems::restore(const Json& kept) {
  if (!kept.is_array()) throw UserError("The items of the session are not a list.");
  for (const Json& one : kept) {
    if (!one.is_object() || !one.contains("path") || !one["path"].is_string())
      throw UserError("An item of the session has no path.");
    const std::array<fs::path, 1> path{path_of_text(one["path"].get<std::string>())};
    for (auto& place : item_places(path, Folders::as_they_are)) {
      const std::scoped_lock lock(mutex_);
      auto found = std::ranges::find(items_, place.path, [](const Item& item) { return item.place.path; });
      if (found == items_.end()) found = items_.insert(items_.end(), new_item(std::move(place)));
      found->condition = label_in(one, "condition", found->condition);
      found->replicate = label_in(one, "replicate", found->replicate);
    }
  }
  look_for_added();
}

Json summary_of(std::size_t number, const ViewItems::Item& item) {
  Json summary{{"item", number},
               {"kind", name_of(item.place.kind)},
               {"name", one_line(item.place.name, 300)},
               {"state", names_of_states.at(static_cast<std::size_t>(item.state))},
               {"condition", item.condition},
               {"replicate", item.replicate}};
  if (!item.error.empty()) summary["error"] = item.error;
  if (!item.version.empty()) summary["version"] = item.version;
  for (const char* key : {"events", "conditions"})
    if (item.description.contains(key)) summary[key] = item.description[key];
  return summary;
}

}  // namespace rheocyte

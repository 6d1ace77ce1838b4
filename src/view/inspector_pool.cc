#include "view/inspector_pool.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "case/json_guard.h"
#include "case/user_error.h"
#include "store/file_version.h"
#include "view/path_text.h"

namespace rheocyte {

namespace {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

/// Of different recordings; each holds its tables in memory.
constexpr std::size_t most_kept = 2;

/// A process that stays has all the patience of its host (item_work.cc): silence for so long is no answer any more.
Watch with_patience() {
  using Clock = std::chrono::steady_clock;
  constexpr std::chrono::seconds patience(100);
  const auto last_word = std::make_shared<Clock::time_point>(Clock::now());
  return {.progress = [last_word](double) { *last_word = Clock::now(); },
          .stop = [last_word, patience] { return Clock::now() - *last_word > patience; }};
}

/// What the process was begun with: the recording as it is now ("version"), and its tables.
std::string key_of(const Json& recording) {
  const std::array<fs::path, 2> tables{
      path_of_text(recording.value("combined", std::string())),
      path_of_text(recording.value("settings", Json::object()).value("table", std::string()))};
  return json_text(recording) + file_version(tables);
}

}  // namespace

std::string KeptInspectors::inspect(const Json& recording, std::size_t event) {
  const std::string key = key_of(recording);
  const auto ask = [&](Kept& kept) {
    const std::scoped_lock lock(kept.alone);
    kept.work.ask(std::to_string(event));
    return kept.work.all(with_patience());
  };
  if (const auto known = take(key)) try {
      return ask(*known);
    } catch (
        const UserError&) {  // the system may have ended it meanwhile: another one gives the reason, if there is one
      drop(known);
    }
  const auto fresh = begin(recording, key);
  try {
    return ask(*fresh);
  } catch (const UserError&) {
    drop(fresh);
    throw;
  }
}

std::shared_ptr<KeptInspectors::Kept> KeptInspectors::take(const std::string& key) const {
  const std::scoped_lock lock(mutex_);
  const auto found = std::ranges::find_if(kept_, [&](const auto& kept) { return kept->key == key; });
  return found == kept_.end() ? nullptr : *found;
}

std::shared_ptr<KeptInspectors::Kept> KeptInspectors::begin(const Json& recording, const std::string& key) {
  Json request = recording;
  request["do"] = "inspect";
  const std::string file = recording.value("file", std::string());
  auto fresh = std::make_shared<Kept>(file, key, host_.ask(json_text(request)));
  const std::scoped_lock lock(mutex_);
  std::erase_if(kept_, [&](const auto& kept) { return kept->file == file; });
  kept_.push_front(fresh);
  if (kept_.size() > most_kept) kept_.pop_back();
  return fresh;
}

void KeptInspectors::drop(const std::shared_ptr<Kept>& kept) {
  const std::scoped_lock lock(mutex_);
  kept_.remove(kept);
}

}  // namespace rheocyte

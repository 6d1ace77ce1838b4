#include "view/moduli_runs.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <stop_token>
#include <system_error>
#include <vector>

#include "case/json_guard.h"
#include "case/to_path.h"
#include "case/user_error.h"
#include "serve/http.h"
#include "store/file_version.h"
#include "store/system_limit.h"
#include "store/thread.h"
#include "view/moduli_settings.h"
#include "view/page_words.h"
#include "view/path_text.h"

namespace rheocyte {

namespace {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

}  // namespace

struct ModuliRuns::Run {
  ~Run() {
    thread = {};  // stops and joins
    std::error_code not_there;
    fs::remove(companion, not_there);
    fs::remove(several, not_there);
  }

  Json settings;
  std::string command, command_several;
  fs::path companion, several;  ///< the latter empty without a combined table

  bool has_ended_well() const { return std::string_view(state) == "ready"; }
  /// Only then what was computed may be used: it still belongs to the files.
  bool is_ready() const { return has_ended_well() && file_version(files) == version; }
  /// What the process says, or why it says nothing.
  void end(Json said, const std::string& failure);

  mutable std::mutex mutex;     ///< of what follows
  std::vector<fs::path> files;  ///< the recording, tables, and once it has ended those of basins
  std::string version;          ///< of the files, before they were read
  const char* state = "running";
  double done = 0;
  Json report = Json::object();
  std::string error;
  Thread thread;
};

void ModuliRuns::Run::end(Json said, const std::string& failure) {
  state = failure.empty() ? "ready" : "failed";
  error = failure;
  if (failure.empty()) done = 1;
  for (const Json& file : said.value("basins", Json::array())) files.push_back(to_path(file.get<std::string>()));
  version += said.value("version_of_basins", std::string());
  for (const char* key : {"basins", "version_of_basins"}) said.erase(key);
  report = std::move(said);
}

ModuliRuns::ModuliRuns(const ViewItems& items) : items_(items), free_processors_(processors()) {}

ModuliRuns::~ModuliRuns() = default;

void ModuliRuns::start(std::size_t item, const Json& settings, const Client* client) {
  static_cast<void>(items_.recording(item));
  begin(item, extract_options(settings, [this](std::size_t number) { return items_.table(number); }), client);
}

void ModuliRuns::begin(std::size_t item, const ExtractOptions& options, const Client* client) {
  const auto found = items_.recording(item);
  const auto run = std::make_shared<Run>();
  run->settings = all_settings(options);
  run->command = extract_command(options, found.place.path);
  const fs::path combined = items_.combined();
  if (!combined.empty()) run->command_several = moduli_command(moduli_options(options, combined), found.place.path);
  take_out(item);
  run->files = {found.place.path, to_path(options.table), combined};
  // Before it begins: without threads its state is asked for while it is made.
  {
    const std::scoped_lock lock(mutex_);
    const fs::path stem = items_.host().folder() / to_path(fmt::format("item-{}-{}", item, ++started_));
    run->companion = to_path(stem.string() + "_rheocyte.rtdc");
    if (!combined.empty()) run->several = to_path(stem.string() + "_moduli.rtdc");
    runs_[item] = run;
  }
  const Json request{{"do", "moduli"},
                     {"file", path_text(found.place.path)},
                     {"settings", run->settings},
                     {"companion", path_text(run->companion)},
                     {"combined", path_text(combined)},
                     {"several", path_text(run->several)},
                     {"keep", true}};
  // A client whose request was answered with a thread begun waits for nothing.
  const Client* const waits = has_threads ? nullptr : client;
  try {
    run->thread =
        Thread([this, &run = *run, request, waits](const std::stop_token& stop) { compute(run, request, stop, waits); },
               small_stack);
  } catch (const SystemLimit&) {
    take_out(item);
    throw;
  }
}

void ModuliRuns::compute(Run& run, const Json& request, const std::stop_token& stop, const Client* client) {
  while (!free_processors_.try_acquire_for(std::chrono::milliseconds(50)))
    if (stop.stop_requested()) return;
  Json report = Json::object();
  std::string error;
  try {
    run.version = file_version(run.files);
    const auto progress = [&run](double done) {
      const std::scoped_lock lock(run.mutex);
      run.done = std::max(run.done, done);
    };
    const auto is_over = [&] { return stop.stop_requested() || (client && client->has_left()); };
    report = parse_sound_json(items_.host().ask(json_text(request)).all({.progress = progress, .stop = is_over}));
  } catch (const std::exception& reason) {  // also of a system without memory: a thread has no one to report to
    error = reason.what();
  }
  free_processors_.release();
  const std::scoped_lock lock(run.mutex);
  run.end(std::move(report), error);
}

Json ModuliRuns::kept() const {
  Json all = Json::array();
  for (std::size_t item = 0; item < items_.count(); ++item)
    if (const auto run = run_of(item))
      all.push_back({{"path", path_text(items_.at(item).place.path)}, {"settings", run->settings}});
  return all;
}

void ModuliRuns::restore(const Json& kept) {
  if (!kept.is_array()) throw UserError("The moduli of the session are not a list.");
  for (const Json& one : kept) {
    if (!one.is_object() || !one.contains("path") || !one["path"].is_string() || !one.contains("settings"))
      throw UserError("Moduli of the session have no path or no settings.");
    for (std::size_t item = 0; item < items_.count(); ++item) {
      const ItemPlace place = items_.at(item).place;
      if (place.path == path_of_text(one["path"].get<std::string>()) && place.kind == ItemKind::recording &&
          place.error.empty())
        begin(item, options_of_settings(one["settings"]), nullptr);
    }
  }
}

std::shared_ptr<ModuliRuns::Run> ModuliRuns::run_of(std::size_t item) const {
  const std::scoped_lock lock(mutex_);
  const auto found = runs_.find(item);
  return found == runs_.end() ? nullptr : found->second;
}

// What is given back ends outside the lock, for it waits for its thread.
std::shared_ptr<ModuliRuns::Run> ModuliRuns::take_out(std::size_t item) {
  const std::scoped_lock lock(mutex_);
  const auto found = runs_.extract(item);
  return found.empty() ? nullptr : found.mapped();
}

void ModuliRuns::stop(std::size_t item) {
  static_cast<void>(items_.recording(item));
  take_out(item);
}

Json ModuliRuns::state(std::size_t item) const {
  static_cast<void>(items_.recording(item));
  const auto run = run_of(item);
  if (!run) return {{"state", "none"}, {"done", 0}};
  const std::scoped_lock lock(run->mutex);
  Json state{{"state", run->state}, {"done", run->done}, {"settings", run->settings}, {"command", run->command}};
  if (!run->command_several.empty()) state["command_several"] = run->command_several;
  if (run->has_ended_well() && !run->is_ready()) {
    state["state"] = "failed";
    state["error"] = "The recording or its table has changed since its moduli were computed; compute them again.";
    return state;
  }
  if (!run->error.empty()) state["error"] = in_words_of_page(run->error);
  state.update(run->report);
  return state;
}

Json ModuliRuns::settings(std::size_t item) const {
  const auto run = run_of(item);
  return run ? run->settings : Json::object();
}

fs::path ModuliRuns::companion(std::size_t item) const {
  const auto run = run_of(item);
  if (!run) return {};
  const std::scoped_lock lock(run->mutex);
  return run->is_ready() ? run->companion : fs::path();
}

fs::path ModuliRuns::several(std::size_t item) const {
  const auto run = run_of(item);
  std::error_code error;
  if (!run || companion(item).empty() || !fs::exists(run->several, error)) return {};
  return run->several;
}

Json ModuliRuns::counts(std::size_t item) const {
  const auto run = run_of(item);
  if (!run) return Json::object();
  const std::scoped_lock lock(run->mutex);
  return run->is_ready() ? run->report.value("counts", Json::object()) : Json::object();
}

Json ModuliRuns::features(std::size_t item) const {
  const auto run = run_of(item);
  if (!run) return Json::array();
  const std::scoped_lock lock(run->mutex);
  return run->is_ready() ? run->report.value("features", Json::array()) : Json::array();
}

}  // namespace rheocyte

// Recordings: /api/items and what is below, and their exports.
#include <algorithm>
#include <atomic>
#include <memory>
#include <nlohmann/json.hpp>
#include <system_error>

#include "case/json_guard.h"
#include "case/split.h"
#include "case/to_path.h"
#include "case/user_error.h"
#include "serve/json_member.h"
#include "store/file_version.h"
#include "view/export_folder.h"
#include "view/item_work.h"
#include "view/moduli_runs.h"
#include "view/moduli_settings.h"
#include "view/modulus_states.h"
#include "view/path_text.h"
#include "view/view_items.h"
#include "view/view_session.h"

namespace rheocyte {

namespace {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

/// A folder for what an export needs on its way.
class PassingFolder {
 public:
  explicit PassingFolder(const WorkHost& host) {
    static std::atomic<int> made{0};
    path_ = host.folder() / to_path("export-" + std::to_string(++made));
    std::error_code error;
    if (!fs::create_directory(path_, error))
      throw UserError("No folder for temporary files can be made; is the disk full?");
  }
  ~PassingFolder() {
    std::error_code error;
    fs::remove_all(path_, error);
  }
  PassingFolder(const PassingFolder&) = delete;
  PassingFolder& operator=(const PassingFolder&) = delete;
  std::string operator/(const char* name) const { return path_text(path_ / to_path(name)); }

 private:
  fs::path path_;
};

/// Answers requests about recordings.
class RecordingAnswers {
 public:
  explicit RecordingAnswers(ViewItems& items) : items_(items), runs_(items) {}

  Answer list() {
    Json all = items_.list();
    for (Json& one : all)
      if (const Json counts = runs_.counts(one["item"]); !counts.empty()) one["counts"] = counts;
    return json_answer(all);
  }

  Answer item(const Request& request) const {
    const std::size_t number = request.number("item");
    const auto found = items_.at(number);
    Json tree = summary_of(number, found);
    for (const auto& [key, value] : found.description.items()) tree[key] = value;
    if (tree.contains("features"))
      for (const auto& name : runs_.features(number))
        if (std::ranges::find(tree["features"], name) == tree["features"].end()) tree["features"].push_back(name);
    return json_answer(tree);
  }

  Answer label(const Request& request) {
    items_.label(request.number("item"), request.json());
    return item(request);
  }

  Answer columns(const Request& request) const {
    constexpr std::size_t most_features = 64;
    const std::string list = request.asked("features");
    const auto features = split(list, ',');
    const std::string type = request.asked("type", "float32");
    if (list.empty() || features.size() > most_features)
      throw Refused(400, "input", "features names the columns, one to 64 of them, with commas between them.");
    if (type != "float32" && type != "float64") throw Refused(400, "input", "type is float32 or float64.");
    const auto work = std::make_shared<HostedWork>(
        work_on_item(request, {{"do", "columns"}, {"features", features}, {"type", type}}));
    std::string head;
    const Watch watch = request.watch();
    const auto take_head = [&head](std::string_view piece) {
      head = piece;
      return false;
    };
    work->read(take_head, watch);
    Answer answer;
    answer.type = "application/octet-stream";
    answer.headers = {{"X-Rheocyte-Columns", head}};
    answer.give_pieces = [work, watch](const TakePiece& take) { work->read(take, watch); };
    return answer;
  }

  Answer event(const Request& request) {
    Json recording = recording_in(request);
    recording["combined"] = path_text(items_.combined());
    return {.body = items_.inspectors().inspect(recording, request.number("event"))};
  }

  Answer picture(const Request& request, const std::string& feature) const {
    // Of a recording that is still being described nothing is known: who reads the picture says whether there is one.
    const Json description = items_.recording(request.number("item")).description;
    const Json pictures = description.is_object() ? description.value("pictures", Json({feature})) : Json({feature});
    if (std::ranges::find(pictures, Json(feature)) == pictures.end())
      throw Refused(404, "unknown", "The recording contains no pictures of the kind " + feature + ".");
    const Json wanted{{"do", "picture"}, {"event", request.number("event")}, {"picture", feature}};
    return {.type = "image/png", .body = work_on_item(request, wanted).all(request.watch())};
  }

  Answer lines(const Request& request) const {
    const Json wanted{{"do", "lines"}, {"x", request.asked("x", "area_um")}, {"y", request.asked("y", "deform")}};
    return {.body = work_on_item(request, wanted).all(request.watch())};
  }

  Answer start_moduli(const Request& request) {
    runs_.start(request.number("item"), request.body.empty() ? Json::object() : request.json(), request.client);
    return json_answer(runs_.state(request.number("item")), 202);
  }

  Answer moduli(const Request& request) const { return json_answer(runs_.state(request.number("item"))); }

  Answer stop_moduli(const Request& request) {
    runs_.stop(request.number("item"));
    return moduli(request);
  }

  /// Of the events within gates alone, with the settings of the item's moduli.
  Answer report(const Request& request) const {
    if (runs_.companion(request.number("item")).empty())
      throw Refused(409, "changed", "There are no moduli of the recording as it is now; compute them first.");
    const Json asked = request.json();
    Json wanted = recording_in(request);
    wanted["do"] = "report";
    for (const char* name : {"min", "max", "polygon"})
      for (const Json& gate : list_member(asked, name)) wanted["settings"][name].push_back(gate);
    refuse_polygon_files(wanted["settings"]);
    take_gate(asked, wanted);
    return {.body = ask(wanted).all(request.watch())};
  }

  Json kept_moduli() const { return runs_.kept(); }
  void restore_moduli(const Json& kept) { runs_.restore(kept); }

  /// With the settings of the item's moduli, as `rheocyte extract` writes the file.
  fs::path write_companion(const Json& wish, const Request& request, ExportFolder& folder) const {
    Json wanted = export_request(wish);
    ExportPlace place = folder.claim(file_name(wish, ".rtdc"));
    wanted["companion"] = path_text(place.scratch());
    static_cast<void>(ask(wanted).all(request.watch()));
    place.publish();
    return place.path();
  }

  fs::path write_events(const Json& wish, const Request& request, ExportFolder& folder) const {
    Json wanted = export_request(wish);
    ExportPlace place = folder.claim(file_name(wish, ".tsv"));
    const PassingFolder passing(items_.host());
    wanted["companion"] = passing / "companion.rtdc";
    wanted["events"] = passing / "events.tsv";
    const bool is_gated = wanted.contains("gate");
    if (!is_gated) wanted["events"] = path_text(place.scratch());
    if (is_gated) wanted["events_of_gate"] = path_text(place.scratch());
    static_cast<void>(ask(wanted).all(request.watch()));
    place.publish();
    return place.path();
  }

 private:
  /// The work on the item of a request, with what has been computed from it.
  HostedWork work_on_item(const Request& request, Json wanted) const {
    wanted.update(recording_in(request));
    return ask(wanted);
  }

  HostedWork ask(const Json& wanted) const { return items_.host().ask(json_text(wanted)); }

  Json recording_in(const Request& request) const {
    const std::size_t number = request.number("item");
    const auto found = items_.recording(number);
    return {{"file", path_text(found.place.path)},
            {"version", file_version(found.files)},
            {"companion", path_text(runs_.companion(number))},
            {"several", path_text(runs_.several(number))},
            {"settings", runs_.settings(number)}};
  }

  Json export_request(const Json& request) const {
    if (!request.contains("item") || !request["item"].is_number_unsigned())
      throw Refused(400, "input", "item is the number of a recording.");
    const std::size_t number = request["item"];
    const auto found = items_.recording(number);
    if (request.contains("version") && request["version"] != file_version(found.files))
      throw Refused(409, "changed", "The recording has changed since its events were read; read them again.");
    Json wanted{{"do", "moduli"}, {"file", path_text(found.place.path)}, {"settings", runs_.settings(number)}};
    take_gate(request, wanted);
    return wanted;
  }

  static void take_gate(const Json& request, Json& wanted) {
    if (!request.contains("gate") || request["gate"].is_null()) return;
    const Json& gate = request["gate"];
    if (!gate.is_array() || !std::ranges::all_of(gate, [](const Json& one) { return one.is_number_unsigned(); }))
      throw Refused(400, "input", "gate is a list of the numbers of events, counted from 0, or null.");
    wanted["gate"] = gate;
  }

  static std::string file_name(const Json& request, std::string_view ending) {
    const Json name = request.value("name", Json());
    if (!name.is_string() || !name.get<std::string>().ends_with(ending))
      throw Refused(400, "input", "name is that of a file that ends in " + std::string(ending) + ".");
    return name.get<std::string>();
  }

  ViewItems& items_;
  ModuliRuns runs_;
};

void add_recording_routes(const ViewContext& view) {
  const auto answers = std::make_shared<RecordingAnswers>(view.items);
  const auto add = [&](std::string_view method, std::string_view pattern, auto answer) {
    view.router.add(method, pattern,
                    [answers, answer](const Request& request) { return ((*answers).*answer)(request); });
  };
  view.router.add("GET", "/api/states", [](const Request&) { return json_answer(modulus_states()); });
  view.router.add("GET", "/api/items", [answers](const Request&) { return answers->list(); });
  add("GET", "/api/items/{item}", &RecordingAnswers::item);
  add("PATCH", "/api/items/{item}", &RecordingAnswers::label);
  add("GET", "/api/items/{item}/events", &RecordingAnswers::columns);
  add("GET", "/api/items/{item}/events/{event}", &RecordingAnswers::event);
  for (const std::string feature : {"image", "mask"})
    view.router.add("GET", "/api/items/{item}/events/{event}/" + feature,
                    [answers, feature](const Request& request) { return answers->picture(request, feature); });
  add("GET", "/api/items/{item}/lines", &RecordingAnswers::lines);
  add("POST", "/api/items/{item}/moduli", &RecordingAnswers::start_moduli);
  add("GET", "/api/items/{item}/moduli", &RecordingAnswers::moduli);
  add("DELETE", "/api/items/{item}/moduli", &RecordingAnswers::stop_moduli);
  view.router.add(
      "POST", "/api/items/{item}/report", [answers](const Request& request) { return answers->report(request); },
      big_body_limit);
  view.exports.add("companion", [answers](const Json& wish, const Request& request, ExportFolder& folder) {
    return answers->write_companion(wish, request, folder);
  });
  view.exports.add("events", [answers](const Json& wish, const Request& request, ExportFolder& folder) {
    return answers->write_events(wish, request, folder);
  });
  view.session.add({"items", [&items = view.items] { return items.kept(); },
                    [&items = view.items](const Json& kept) { items.restore(kept); }});
  view.session.add({"moduli", [answers] { return answers->kept_moduli(); },
                    [answers](const Json& kept) { answers->restore_moduli(kept); }});
}

}  // namespace

extern const ViewPart recording_routes{add_recording_routes, work_on_items()};

}  // namespace rheocyte

#include "view/item_work.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "case/json_guard.h"
#include "case/user_error.h"
#include "report/extract_recording.h"
#include "store/file_version.h"
#include "store/thread.h"
#include "view/describe_item.h"
#include "view/event_inspector.h"
#include "view/moduli_settings.h"
#include "view/path_text.h"
#include "view/recording_columns.h"
#include "view/recording_lines.h"
#include "view/recording_moduli.h"

namespace rheocyte {

namespace {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

constexpr std::size_t block = std::size_t{1} << 16U;  // events; memory stays small however many there are

fs::path path_in(const Json& request, const char* key) { return path_of_text(request.value(key, std::string())); }

/// An open recording with its companion, if something has been computed from it.
struct OpenRecording {
  explicit OpenRecording(const Json& request, const TellProgress& tell) : recording(path_in(request, "file")) {
    tell_to(tell);
    if (const fs::path file = path_in(request, "companion"); !file.empty()) companion.emplace(file);
    if (const fs::path file = path_in(request, "several"); !file.empty()) several.emplace(file);
  }
  /// The client gets progress while the recording is read.
  void tell_to(const TellProgress& tell) {
    recording.on_piece(now_and_then([tell] { tell(0); }));
  }
  ComputedFiles computed() const { return {companion ? &*companion : nullptr, several ? &*several : nullptr}; }

  Recording recording;
  std::optional<Recording> companion, several;
};

ItemKind kind_in(const Json& request) {
  for (const auto kind : {ItemKind::case_file, ItemKind::result, ItemKind::table, ItemKind::combined})
    if (request.value("kind", "") == name_of(kind)) return kind;
  return ItemKind::recording;
}

void describe(const Json& request, const WorkReply& reply, const TellProgress&) {
  reply.give(json_text(describe_item({.kind = kind_in(request), .path = path_in(request, "file")})));
}

void list_columns(const Json& request, const WorkReply& reply, const TellProgress& tell) {
  const OpenRecording open(request, tell);
  reply.give(json_text(RecordingColumns(open.recording, open.computed()).names()));
}

// First what follows, then the columns one after another.
void give_columns(const Json& request, const WorkReply& reply, const TellProgress& tell) {
  const OpenRecording open(request, tell);
  RecordingColumns columns(open.recording, open.computed());
  const auto names = request.at("features").get<std::vector<std::string>>();
  const NumberType type = request.value("type", "") == "float64" ? NumberType::float64 : NumberType::float32;
  std::vector<double> values;
  for (const auto& name : names) columns.read(name, 0, {});
  // One line: it becomes the value of a header.
  reply.give(json_line({{"features", names},
                        {"events", columns.events()},
                        {"version", request.value("version", "")},
                        {"type", type == NumberType::float64 ? "float64" : "float32"}}));
  for (const auto& name : names)
    for (std::size_t first = 0; first < columns.events(); first += block) {
      values.resize(std::min(block, columns.events() - first));
      columns.read(name, first, values);
      std::string bytes;
      append_numbers(values, type, bytes);
      reply.give(bytes);
    }
}

/// A recording, tables and settings for all events that are asked for.
struct Inspection {
  Inspection(const Json& request, const TellProgress& tell)
      : open(request, tell),
        options(options_of_settings(request.at("settings"))),
        tables(options.table, options.section),
        combined(combined_tables(path_in(request, "combined"), options)),
        inspector({open.recording, open.computed(), combined ? &*combined : nullptr}, options, tables) {}

  static std::optional<ModuliTables> combined_tables(const fs::path& folder, const ExtractOptions& options) {
    if (folder.empty()) return std::nullopt;
    return std::optional<ModuliTables>(std::in_place, moduli_options(options, folder));
  }

  OpenRecording open;
  ExtractOptions options;
  ModulusTables tables;
  std::optional<ModuliTables> combined;
  EventInspector inspector;
};

/// Stays until no one asks for an event any more.
void inspect_events(const Json& request, const WorkReply& reply, const TellProgress& tell) {
  auto& inspection = reply.kept<Inspection>(request, tell);
  inspection.open.tell_to(tell);
  while (const auto event = reply.next_request()) {
    Json found = inspection.inspector.inspect(std::stoul(*event));
    found["version"] = request.value("version", "");
    reply.give(json_text(found));
    reply.end_answer();
  }
}

void give_picture(const Json& request, const WorkReply& reply, const TellProgress&) {
  reply.give(picture_of_event(Recording(path_in(request, "file")), request.at("picture"), request.at("event")));
}

void give_lines(const Json& request, const WorkReply& reply, const TellProgress&) {
  reply.give(json_text(recording_lines(Recording(path_in(request, "file")), options_of_settings(request.at("settings")),
                                       request.at("x"), request.at("y"))));
}

std::optional<std::vector<std::size_t>> gate_in(const Json& request) {
  if (!request.contains("gate")) return {};
  return request["gate"].get<std::vector<std::size_t>>();
}

/// Moduli of bulk and cortex beside the others, where a combined table is among the items: its lines and features are
/// added to the report, or why there are none.
void add_bulk_cortex_fit(const Json& request, const ExtractOptions& options, const TellProgress& tell, Json& report) {
  const fs::path folder = path_in(request, "combined"), target = path_in(request, "several");
  if (folder.empty() || target.empty()) return;
  try {
    const ModuliOptions wanted = moduli_options(options, folder);
    const ModuliTables tables(wanted);
    ModuliCompanion companion(target);
    const ModuliSummary summary =
        moduli_of_recording(path_in(request, "file"), wanted, tables, processors(), companion, tell);
    report["lines"].push_back(tables.computed().content.spec.identifier + ": " + in_one_line(summary));
    for (const auto& lines : {lines_of(summary), summary.warnings})
      for (const auto& line : lines) report["lines"].push_back(line);
    for (const ColumnDescription& feature : moduli_features()) report["features"].push_back(feature.role);
  } catch (const UserError& error) {
    std::error_code not_there;
    fs::remove(target, not_there);
    report["lines"].push_back(error.what());
  }
}

/// Of the events within the gates alone, which is no matter of a companion.
void give_report(const Json& request, const WorkReply& reply, const TellProgress& tell) {
  const fs::path file = path_in(request, "file");
  ExtractOptions options = options_of_settings(request.at("settings"));
  options.measuring.gates.events = gate_in(request);
  const ModulusTables tables(options.table, options.section);
  check_against_tables(options, tables);
  reply.give(json_text(moduli_report(file, summary_of_recording(file, options, tables, tell))));
}

/// The other files that the recording is read from, and what they are now.
Json basins_of(const fs::path& file) {
  const auto basins = Recording(file).files_of_basins();
  return {{"basins", paths_json(basins)}, {"version_of_basins", file_version(basins)}};
}

// The files are published here, as the command does: the process that reads may break.
void compute_moduli(const Json& request, const WorkReply& reply) {
  const fs::path file = path_in(request, "file");
  ExtractOptions options = options_of_settings(request.at("settings"));
  options.measuring.gates.events = gate_in(request);
  const ModulusTables tables(options.table, options.section);
  check_against_tables(options, tables);
  const ExtractOutput output{path_in(request, "companion"), path_in(request, "events"), request.value("keep", false)};
  ExtractFiles files(output, !output.events.empty());
  // Several moduli take by far longer than one.
  const double fraction = path_in(request, "several").empty() ? 1 : 0.1;
  const auto work = [&](const TellProgress& tell) {
    const Json basins = basins_of(file);
    const auto tell_first = [&](double done) { tell(fraction * done); };
    const auto tell_second = [&](double done) { tell(fraction + (1 - fraction) * done); };
    Json report = moduli_report(file, extract_recording(file, files, options, tables, tell_first));
    report["features"] = Json::array();
    for (const auto& column : computed_columns(Recording(files.companion()))) report["features"].push_back(column.name);
    add_bulk_cortex_fit(request, options, tell_second, report);
    report.update(basins);
    reply.give(json_text(report));
  };
  reply.run_isolated(file, work, {.patience_s = options.measuring.patience_s.value_or(default_patience_s)});
  files.publish();
  if (const fs::path place = path_in(request, "events_of_gate"); !place.empty()) {
    AtomicFile target(place);
    copy_events_of_gate(output.events, target.scratch(), options.measuring.gates.events.value());
    target.publish();
  }
}

/// Who waits for the next question is silent: the one who asks loses patience with an answer.
constexpr double patience_of_those_who_stay_s = 1e9;

}  // namespace

std::vector<ItemWork> work_on_items() {
  return {{"describe", describe},    {"names", list_columns},
          {"columns", give_columns}, {"inspect", inspect_events, {.patience_s = patience_of_those_who_stay_s}},
          {"picture", give_picture}, {"lines", give_lines},
          {"report", give_report}};
}

void do_item_work(const std::string& text, const WorkReply& reply) {
  const Json request = parse_sound_json(text);
  const std::string wanted = request.value("do", "");
  for (const ViewPart* const part : view_parts())
    for (const auto& [name, work, limits] : part->item_work)
      if (wanted == name)
        return reply.run_isolated(
            path_in(request, "file"), [&, do_work = work](const TellProgress& tell) { do_work(request, reply, tell); },
            limits);
  if (wanted == "moduli") return compute_moduli(request, reply);
  throw UserError("There is no such work on an item.");
}

}  // namespace rheocyte

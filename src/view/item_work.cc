#include "view/item_work.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "case/json_guard.h"
#include "case/user_error.h"
#include "view/describe_item.h"
#include "view/event_columns.h"

namespace rheocyte {

namespace {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

constexpr std::size_t block = std::size_t{1} << 16U;  // events; memory stays small however many there are

fs::path path_in(const Json& request, const char* key) { return request.value(key, std::string()); }

/// An open recording with its companion, if something has been computed from it.
struct OpenRecording {
  explicit OpenRecording(const Json& request, const TellProgress& tell) : recording(path_in(request, "file")) {
    recording.on_piece(now_and_then([tell] { tell(0); }));
    if (const fs::path file = path_in(request, "companion"); !file.empty()) companion.emplace(file);
  }
  const Recording* computed() const { return companion ? &*companion : nullptr; }

  Recording recording;
  std::optional<Recording> companion;
};

ItemKind kind_in(const Json& request) {
  for (const auto kind : {ItemKind::case_file, ItemKind::result, ItemKind::table})
    if (request.value("kind", "") == name_of(kind)) return kind;
  return ItemKind::recording;
}

void describe(const Json& request, const WorkReply& reply, const TellProgress&) {
  reply.give(json_text(describe_item({.kind = kind_in(request), .path = path_in(request, "file")})));
}

void list_columns(const Json& request, const WorkReply& reply, const TellProgress& tell) {
  const OpenRecording open(request, tell);
  reply.give(json_text(EventColumns(open.recording, open.computed()).names()));
}

// First what follows, then the columns one after another.
void give_columns(const Json& request, const WorkReply& reply, const TellProgress& tell) {
  const OpenRecording open(request, tell);
  EventColumns columns(open.recording, open.computed());
  const auto names = request.at("features").get<std::vector<std::string>>();
  const NumberType type = request.value("type", "") == "float64" ? NumberType::float64 : NumberType::float32;
  std::vector<double> values;
  for (const auto& name : names) columns.read(name, 0, {});
  // One line: it becomes the value of a header.
  reply.give(json_line({{"features", names},
                        {"events", columns.events()},
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

using Contained = void (*)(const Json&, const WorkReply&, const TellProgress&);
struct Named {
  const char* name;
  Contained work;
};
constexpr Named contained_work[]{{"describe", describe}, {"names", list_columns}, {"columns", give_columns}};

}  // namespace

void do_item_work(const std::string& text, const WorkReply& reply) {
  const Json request = parse_sound_json(text);
  const std::string wanted = request.value("do", "");
  for (const auto& [name, work] : contained_work)
    if (wanted == name)
      return reply.run_contained(path_in(request, "file"),
                                 [&](const TellProgress& tell) { work(request, reply, tell); });
  throw UserError("There is no such work on an item.");
}

}  // namespace rheocyte

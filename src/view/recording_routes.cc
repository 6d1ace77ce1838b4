#include "view/recording_routes.h"

#include <memory>
#include <nlohmann/json.hpp>
#include <sstream>

#include "case/json_guard.h"
#include "view/view_items.h"

namespace rheocyte {

namespace {

using Json = nlohmann::ordered_json;

std::vector<std::string> names_in(const std::string& list) {
  std::vector<std::string> names;
  std::istringstream stream(list);
  for (std::string name; std::getline(stream, name, ',');) names.push_back(name);
  return names;
}

Answer item(const ViewItems& items, const Request& request) {
  const std::size_t number = request.number("item");
  const auto found = items.at(number);
  Json tree = summary_of(number, found);
  for (const auto& [key, value] : found.description.items()) tree[key] = value;
  return json_answer(tree);
}

Answer label(ViewItems& items, const Request& request) {
  items.label(request.number("item"), request.json());
  return item(items, request);
}

Answer columns(const ViewItems& items, const Request& request) {
  constexpr std::size_t most_features = 64;
  const auto found = items.recording(request.number("item"));
  const auto features = names_in(request.asked("features"));
  const std::string type = request.asked("type", "float32");
  if (features.empty() || features.size() > most_features)
    throw Refused(400, "input", "features names the columns, one to 64 of them, with commas between them.");
  if (type != "float32" && type != "float64") throw Refused(400, "input", "type is float32 or float64.");
  const Json wanted{{"do", "columns"}, {"file", found.place.path.string()}, {"features", features}, {"type", type}};
  const auto work = std::make_shared<HostedWork>(items.host().ask(json_text(wanted)));
  std::string head;
  work->read([&head](std::string_view piece) {
    head = piece;
    return false;
  });
  Answer answer;
  answer.type = "application/octet-stream";
  answer.headers = {{"X-Rheocyte-Columns", head}};
  answer.give_pieces = [work](const TakePiece& take) { work->read(take); };
  return answer;
}

}  // namespace

void add_recording_routes(Router& router, Exports&, ViewSession& session, ViewItems& items) {
  router.add("GET", "/api/items", [&items](const Request&) { return json_answer(items.list()); });
  router.add("GET", "/api/items/{item}", [&items](const Request& request) { return item(items, request); });
  router.add("PATCH", "/api/items/{item}", [&items](const Request& request) { return label(items, request); });
  router.add("GET", "/api/items/{item}/events", [&items](const Request& request) { return columns(items, request); });
  session.add({"items", [&items] { return items.kept(); }, [&items](const Json& kept) { items.restore(kept); }});
}

}  // namespace rheocyte

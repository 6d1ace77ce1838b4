// POST /api/population takes {"conditions": [{"name", "items": [numbers in the order of the sessions]}], "settings":
// {...}}, the settings of `rheocyte population` but for table and jobs; those of the moduli that it does not have are
// left out. Answers
// {"record": population.json, "lines": [what the command says], "command": for a shell}.
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>

#include "case/json_guard.h"
#include "case/user_error.h"
#include "events/recording_settings.h"
#include "experiment/analyse_populations.h"
#include "report/population_files.h"
#include "report/population_lines.h"
#include "report/settings_text.h"
#include "serve/few_at_once.h"
#include "serve/json_member.h"
#include "serve/router.h"
#include "view/moduli_settings.h"
#include "view/path_text.h"
#include "view/view_items.h"
#include "view/view_part.h"

namespace rheocyte {

namespace {

using Json = nlohmann::ordered_json;

PopulationOptions population_options(const Json& settings) {
  PopulationOptions options;
  take_settings(settings_of(options), settings);
  check_options(options.measuring);
  return options;
}

/// No path is ever taken from a page, nor how busy it may make the machine.
Json population_settings(const Json& given) {
  PopulationOptions none;
  Json settings = Json::object();
  for (const Setting& setting : settings_of(none)) {
    const std::string name(setting.name);
    if (name != "table" && name != "jobs" && given.contains(name)) settings[name] = given[name];
  }
  const Json model = settings.value("model", Json());
  if (model != "cortex" && model != "effective") settings.erase("section");  // of the moduli beside it
  refuse_polygon_files(settings);
  return settings;
}

/// As the host reads them, and in "command" as a shell does.
Json population_work(const Json& asked, const ViewItems& items) {
  const Json settings = asked.contains("settings") ? object_member(asked, "settings") : Json::object();
  Json work{{"do", "population"}, {"settings", population_settings(settings)}};
  PopulationOptions options = population_options(work["settings"]);
  std::string command = "rheocyte population";
  for (const Json& condition : list_member(asked, "conditions")) {
    if (!condition.is_object()) throw UserError("A condition is an object with a name and items.");
    const std::string name = text_member(condition, "name");
    Json recordings = Json::array();
    std::string files = name;
    for (const Json& item : list_member(condition, "items")) {
      if (!item.is_number_unsigned()) throw UserError("items are the numbers of recordings.");
      const auto path = items.recording(item).place.path;
      files += recordings.empty() ? '=' : ',';
      files += path.string();
      recordings.push_back(path_text(path));
    }
    command += " --condition " + quoted_for_shell(files);
    work["conditions"].push_back({{"name", name}, {"recordings", recordings}});
  }
  if (!work.contains("conditions") || work["conditions"][0]["recordings"].empty())
    throw UserError("Name the condition of at least one recording in the list.");
  work["file"] = work["conditions"][0]["recordings"][0];
  work["command"] = command + options_text(settings_of(options));
  return work;
}

/// In the process that reads the recordings.
void compute_population(const Json& request, const WorkReply& reply, const TellProgress& tell) {
  PopulationOptions options = population_options(request.at("settings"));
  options.jobs = 1;
  std::vector<PopulationCondition> conditions;
  for (const Json& one : request.at("conditions")) {
    auto& condition = conditions.emplace_back(PopulationCondition{one.at("name").get<std::string>(), {}});
    for (const Json& path : one.at("recordings")) condition.recordings.push_back(path_of_text(path.get<std::string>()));
  }
  check_conditions(conditions, options.paired);
  const PopulationReport report = analyse(conditions, options, {.progress = tell});
  reply.give(json_text({{"record", population_record(report)},
                        {"lines", population_lines(report)},
                        {"command", request.at("command")}}));
}

Answer population(ViewItems& items, const Request& request) {
  return {.body = items.host().ask(json_text(population_work(request.json(), items))).all(request.watch())};
}

/// Between two signs of life there is the fit of a whole recording.
constexpr double patience_with_fits_s = 600;

void add_population_routes(const ViewContext& view) {
  constexpr int most = 4;
  const auto under_way =
      std::make_shared<FewAtOnce>(most, "Several populations are being computed already; wait for their end.");
  view.router.add("POST", "/api/population", [&items = view.items, under_way](const Request& request) {
    const FewAtOnce::Turn turn = under_way->begin();
    return population(items, request);
  });
}

}  // namespace

extern const ViewPart population_routes{add_population_routes,
                                        {{"population", compute_population, {.patience_s = patience_with_fits_s}}}};

}  // namespace rheocyte

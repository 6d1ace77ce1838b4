#include "app/population_spec.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <string>

#include "case/case_text.h"
#include "case/to_path.h"
#include "case/toml_json.h"
#include "case/user_error.h"
#include "events/recording_settings.h"
#include "report/settings_text.h"

namespace rheocyte {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

PopulationCondition condition_in(const std::string& name, const Json& recordings, const fs::path& folder) {
  PopulationCondition condition{name, {}};
  const Json list = recordings.is_string() ? Json::array({recordings}) : recordings;
  for (const Json& recording : list) {
    if (!list.is_array() || !recording.is_string() || recording.get_ref<const std::string&>().empty())
      throw UserError(fmt::format("the condition {} must be a list of recordings, such as [\"A1.rtdc\", \"A2.rtdc\"].",
                                  one_line(name, 60)));
    condition.recordings.push_back(folder / to_path(recording.get<std::string>()));
  }
  return condition;
}

/// A section of limits as the options have them: {"area_um": 40} is ["area_um=40"].
Json limits_in(const Json& section) {
  Json limits = Json::array();
  for (const auto& [feature, limit] : section.items()) {
    if (!limit.is_number()) throw UserError(fmt::format("the limit of {} must be a number.", one_line(feature, 60)));
    limits.push_back(fmt::format("{}={}", feature, limit.get<double>()));
  }
  return limits;
}

PopulationSpec spec_in(const Json& given, const fs::path& folder) {
  PopulationSpec spec;
  Json settings = Json::object();
  for (const auto& [key, value] : given.items()) {
    if (key != "conditions") {
      settings[key] = value.is_object() ? limits_in(value) : value;
      continue;
    }
    if (!value.is_object()) throw UserError("conditions must be a section of names with lists of recordings.");
    for (const auto& [name, recordings] : value.items())
      spec.conditions.push_back(condition_in(name, recordings, folder));
  }
  take_settings(settings_of(spec.options), settings);
  return spec;
}

}  // namespace

PopulationSpec read_population_spec(const fs::path& file) {
  const std::string name = file.filename().string();
  constexpr TextKind kind = specification("population", true);
  const Json given = json_of_toml(read_case_text(file, kind), name, kind);
  try {
    return spec_in(given, file.parent_path());
  } catch (const UserError& error) {
    throw UserError(fmt::format("{}: {}", name, error.what()));
  }
}

}  // namespace rheocyte

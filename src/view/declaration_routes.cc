// GET /api/health, /api/keys, /api/settings, /api/features, /api/media, /api/media/viscosity: what can be asked for.
#include <array>
#include <nlohmann/json.hpp>
#include <utility>

#include "case/case_keys.h"
#include "case/user_error.h"
#include "events/recording_settings.h"
#include "measurement/viscosity.h"
#include "numeric/number_from_chars.h"
#include "report/settings_text.h"
#include "serve/router.h"
#include "store/build_info.h"
#include "store/thread.h"
#include "view/recording_columns.h"
#include "view/view_part.h"

namespace rheocyte {

namespace {

using Json = nlohmann::ordered_json;

Json health() { return {{"status", "ok"}, {"program", "rheocyte"}, {"version", version}, {"threads", processors()}}; }

Json value_of(const KeyDescription& key, const Value& value) {
  if (std::holds_alternative<int>(value)) return option_of(key, value);
  if (const auto* number = std::get_if<double>(&value)) return *number;
  if (const auto* word = std::get_if<std::string>(&value)) return *word;
  if (const auto* list = std::get_if<std::vector<double>>(&value)) return *list;
  return nullptr;
}

/// What may be given.
Json kind_of(const KeyDescription& key) {
  const auto with_range = [](const char* kind, const Range& range) {
    return Json{{"kind", kind}, {"least", range.least}, {"greatest", range.greatest}};
  };
  if (const auto* number = std::get_if<Number>(&key.kind)) {
    Json kind = with_range("number", number->range);
    kind["whole"] = number->is_whole;
    return kind;
  }
  if (const auto* list = std::get_if<List>(&key.kind)) return with_range("list", list->range);
  if (const auto* choice = std::get_if<Choice>(&key.kind)) return {{"kind", "choice"}, {"options", choice->options}};
  return {{"kind", "word"}};
}

Json description_of(const KeyDescription& key, const KeyList& keys) {
  Json json{{"name", key.name},
            {"section", key.name.substr(0, key.name.rfind('.'))},
            {"unit", key.unit},
            {"sentence", key.sentence}};
  json.update(kind_of(key));
  const Value* usual = fallback_of(key);
  json["default"] = usual ? value_of(key, *usual) : Json(nullptr);
  json["required"] = is_required(key, keys);
  json["only_for"] = nullptr;
  if (const auto& condition = key.only_for)
    json["only_for"] = {{"key", condition->key}, {"option", condition->option}, {"negated", condition->negated}};
  json["alternative"] = key.alternative.empty() ? Json(nullptr) : Json(key.alternative);
  return json;
}

Json keys_of_cases() {
  const KeyList keys = key_list(case_keys());
  Json list = Json::array();
  for (const auto* key : keys) list.push_back(description_of(*key, keys));
  return list;
}

/// The field's media under the names that the field gives them.
constexpr std::array<std::pair<std::string_view, Medium>, 4> media{{{"CellCarrier", Medium::methyl_cellulose_049},
                                                                    {"CellCarrierB", Medium::methyl_cellulose_059},
                                                                    {"0.83% MC-PBS", Medium::methyl_cellulose_083},
                                                                    {"water", Medium::water}}};

Json known_media() {
  Json list = Json::array();
  for (const auto& [name, medium] : media) {
    Json models = Json::array();
    for (const auto model : {ViscosityModel::buyukurganci_2022, ViscosityModel::herold_2017}) {
      if (medium == Medium::methyl_cellulose_083 && model == ViscosityModel::herold_2017) continue;
      const Buffer buffer(medium, model);
      models.push_back({{"model", name_of(buffer.model())},
                        {"lowest_C", buffer.measured().lowest},
                        {"highest_C", buffer.measured().highest}});
      if (medium == Medium::water) break;
    }
    list.push_back({{"medium", name}, {"name", name_of(medium)}, {"models", models}});
  }
  return list;
}

double asked_temperature(const Request& request) {
  const std::string text = request.asked("temperature");
  double celsius = 0;
  const auto [end, error] = number_from_chars(text.data(), text.data() + text.size(), celsius);
  if (error != std::errc() || end != text.data() + text.size() || !(celsius >= 0 && celsius <= 100))
    throw UserError("temperature: give it in degrees C, 0 .. 100.");
  return celsius;
}

/// The liquid as it stands in [flow] of a case.
Json viscosity(const Request& request) {
  const std::string name = request.asked("medium"), model_name = request.asked("model", "buyukurganci-2022");
  const auto medium = medium_of_name(name);
  if (!medium)
    throw UserError("medium: " + one_line(name, 40) + " is not known" + near_medium(name) +
                    "; GET /api/media lists those that are.");
  const auto model = viscosity_model_of_name(model_name);
  if (!model)
    throw UserError("model: " + one_line(model_name, 40) +
                    " is not known; it can be buyukurganci-2022 or herold-2017.");
  const double celsius = asked_temperature(request);
  const Buffer buffer(*medium, *model);
  const double consistency = buffer.consistency_Pa_sn(celsius);
  if (*medium == Medium::water) return {{"law", "newtonian"}, {"viscosity_mPas", 1e3 * consistency}};
  return {{"law", "power-law"}, {"consistency_Pa_sn", consistency}, {"exponent", buffer.flow_exponent(celsius)}};
}

/// Of moduli of recordings.
Json settings_of_moduli() {
  ExtractOptions none;
  return declared_settings(settings_of(none));
}

/// Of events, beside those that are in the file.
Json features_of_moduli() {
  Json list = Json::array();
  for (const ColumnDescription& feature : computed_features())
    list.push_back(
        {{"name", feature.name}, {"label", feature.label}, {"unit", feature.unit}, {"sentence", feature.sentence}});
  return list;
}

void add_declaration_routes(const ViewContext& view) {
  const auto add = [&](std::string_view pattern, auto declared) {
    view.router.add("GET", pattern, [declared](const Request&) { return json_answer(declared()); });
  };
  add("/api/health", health);
  add("/api/keys", keys_of_cases);
  add("/api/settings", settings_of_moduli);
  add("/api/features", features_of_moduli);
  add("/api/media", known_media);
  view.router.add("GET", "/api/media/viscosity",
                  [](const Request& request) { return json_answer(viscosity(request)); });
}

}  // namespace

extern const ViewPart declaration_routes{add_declaration_routes};

}  // namespace rheocyte

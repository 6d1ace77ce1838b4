#include "report/settings_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <nlohmann/json.hpp>

#include "case/nearest_name.h"
#include "case/user_error.h"

namespace rheocyte {

namespace {

using Json = nlohmann::ordered_json;

/// By the place; a text with a unit can be a number.
std::string_view kind_of(const Setting& setting) {
  constexpr std::string_view text = "text";
  constexpr std::array<std::string_view, std::variant_size_v<SettingPlace>> kinds{
      "number", text, text, "texts", "choice", "flag", "number", "numbers"};
  const std::string_view kind = kinds.at(setting.place.index());
  return kind == text && !setting.unit.empty() ? kinds.front() : kind;
}

Json end_of_range(double end) { return std::isfinite(end) ? Json(end) : Json(); }

SettingValue value_in(const Json& json, const std::string& name) {
  if (json.is_boolean()) return json.get<bool>();
  if (json.is_number()) return json.get<double>();
  if (json.is_string()) return json.get<std::string>();
  if (json.is_array() && !json.empty() && std::ranges::all_of(json, [](const Json& one) { return one.is_number(); }))
    return json.get<std::vector<double>>();
  const bool are_texts = json.is_array() && std::ranges::all_of(json, [](const Json& one) { return one.is_string(); });
  if (!are_texts) throw UserError(fmt::format("{} must be a number, a text, a list of texts, or true or false.", name));
  return json.get<std::vector<std::string>>();
}

struct AsOptions {
  std::string option;

  std::string with(const std::string& value) const { return fmt::format(" {} {}", option, quoted_for_shell(value)); }
  std::string operator()(bool) const { return " " + option; }
  std::string operator()(double number) const { return with(fmt::format("{}", number)); }
  std::string operator()(const std::string& text) const { return with(text); }
  template <class Value>
  std::string operator()(const std::vector<Value>& values) const {
    std::string all;
    for (const Value& value : values) all += (*this)(value);
    return all;
  }
};

}  // namespace

Json declared_settings(const Settings& settings) {
  Json list = Json::array();
  for (const Setting& s : settings)
    list.push_back({{"name", s.name},
                    {"option", option_of(s)},
                    {"label", s.label},
                    {"sentence", s.sentence},
                    {"kind", kind_of(s)},
                    {"unit", s.unit},
                    {"least", end_of_range(s.range.least)},
                    {"greatest", end_of_range(s.range.greatest)},
                    {"words", s.words},
                    {"default", default_of(s)},
                    {"usual", s.is_usual},
                    {"former", s.former_name}});
  return list;
}

void take_settings(const Settings& settings, const Json& given) {
  if (!given.is_object()) throw UserError("The settings must be an object.");
  for (const auto& [name, value] : given.items()) {
    const auto setting = std::ranges::find(settings, name, &Setting::name);
    if (setting == settings.end()) {
      std::vector<std::string_view> names;
      for (const Setting& one : settings) names.push_back(one.name);
      const std::string near = did_you_mean(name, names);
      throw UserError(fmt::format("There is no setting {}{}", one_line(name, 60), near.empty() ? "." : near));
    }
    if (!value.is_null()) take(*setting, value_in(value, name), name);
  }
}

Json given_settings(const Settings& settings) {
  Json given = Json::object();
  for (const Setting& setting : settings)
    if (const auto value = value_of(setting))
      std::visit([&member = given[std::string(setting.name)]](const auto& kind) { member = kind; }, *value);
  return given;
}

std::string options_text(const Settings& settings) {
  std::string text;
  for (const Setting& setting : settings)
    if (const auto value = value_of(setting)) text += std::visit(AsOptions{option_of(setting)}, *value);
  return text;
}

std::string quoted_for_shell(const std::string& text) {
  const auto is_plain = [](unsigned char c) {
    return std::isalnum(c) || std::string_view("_-+=./,:@%").find(char(c)) != std::string_view::npos;
  };
  if (!text.empty() && std::ranges::all_of(text, is_plain)) return text;
  std::string result = "'";
  for (const char c : text) result += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return result + "'";
}

}  // namespace rheocyte

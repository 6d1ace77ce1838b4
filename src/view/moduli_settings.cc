#include "view/moduli_settings.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <nlohmann/json.hpp>
#include <variant>

#include "case/case_keys.h"
#include "case/user_error.h"
#include "extract/polygon_file.h"
#include "extract/shipped_tables.h"
#include "synth/synth_keys.h"
#include "view/path_text.h"

namespace rheocyte {

namespace {

using Json = nlohmann::ordered_json;
using M = MeasuringOptions;
using E = ExtractOptions;

/// A setting, its option, and where its value goes; a quantity with the key that knows its range.
struct Setting {
  using Text = std::string;
  using Texts = std::vector<std::string>;
  const char *name, *option;
  std::variant<std::optional<double> M::*, std::optional<Text> M::*, Text M::*, Text E::*, Texts GateOptions::*,
               bool E::*>
      member;
  const char* key = nullptr;
};

constexpr const char* pixel_key = "recording.pixel_size_um";

const std::array<Setting, 15>& all() {
  static const std::array<Setting, 15> settings{{
      {"table", "--table", &E::table},
      {"channel_width_um", "--channel-width-um", &M::channel_width_um, "channel.width_um"},
      {"flow_rate_ul_s", "--flow-rate-ul-s", &M::flow_rate_ul_s, "flow.rate_ul_per_s"},
      {"pixel_size_um", "--pixel-size-um", &M::pixel_size_um, pixel_key},
      {"viscosity_mPas", "--viscosity-mPas", &M::viscosity_mPas, "flow.viscosity_mPas"},
      {"medium", "--medium", &M::medium},
      {"viscosity_model", "--viscosity-model", &M::viscosity_model},
      {"temperature", "--temperature", &M::temperature},
      {"temperature_if_missing", "--temperature-if-missing", &M::temperature_if_missing},
      {"min", "--min", &GateOptions::min},
      {"max", "--max", &GateOptions::max},
      {"polygon", "--polygon", &GateOptions::polygons},
      {"no_pixelation", "--no-pixelation", &E::no_pixelation},
      {"no_area_correction", "--no-area-correction", &E::no_area_correction},
      {"no_asymmetry", "--no-asymmetry", &E::no_asymmetry},
  }};
  return settings;
}

template <class Options, class Take>
void visit(const Setting& setting, Options& options, const Take& take) {
  std::visit(
      [&](auto member) {
        if constexpr (requires { options.*member; })
          take(options.*member);
        else if constexpr (requires { options.measuring.*member; })
          take(options.measuring.*member);
        else
          take(options.measuring.gates.*member);
      },
      setting.member);
}

[[noreturn]] void refuse(const Setting& setting, std::string_view wanted) {
  throw UserError(fmt::format("The setting {} is {}.", setting.name, wanted));
}

void check_range(const Setting& setting, double value) {
  const std::string_view name = setting.key;
  const KeyDescription& key =
      name == pixel_key ? static_cast<const KeyDescription&>(*find_key(synth_keys(), name)) : case_key(name);
  const Range& range = std::get<Number>(key.kind).range;
  if (!range.contains(value)) refuse(setting, fmt::format("a number within {}", range_text(range, key.unit)));
}

struct FromJson {
  const Setting& setting;
  const Json& value;

  void operator()(std::optional<double>& number) const {
    if (!value.is_number()) refuse(setting, "a number");
    number = value.get<double>();
    check_range(setting, *number);
  }
  void operator()(std::optional<std::string>& text) const { (*this)(text.emplace()); }
  void operator()(std::string& text) const {
    if (value.is_number())
      text = fmt::format("{}", value.get<double>());
    else if (value.is_string())
      text = value.get<std::string>();
    else
      refuse(setting, "a text");
  }
  void operator()(std::vector<std::string>& texts) const {
    if (!value.is_array()) refuse(setting, "a list of texts");
    for (const Json& one : value) {
      if (!one.is_string()) refuse(setting, "a list of texts");
      if (is_polygon_file(one.get_ref<const std::string&>())) refuse(setting, "features and corners, not a file");
      texts.push_back(one.get<std::string>());
    }
  }
  void operator()(bool& flag) const {
    if (!value.is_boolean()) refuse(setting, "true or false");
    flag = value.get<bool>();
  }
};

struct ToJson {
  const char* name;
  Json& tree;

  template <class Value>
  void operator()(const std::optional<Value>& value) const {
    if (value) tree[name] = *value;
  }
  void operator()(const std::string& text) const {
    if (!text.empty()) tree[name] = text;
  }
  void operator()(const std::vector<std::string>& texts) const {
    if (!texts.empty()) tree[name] = texts;
  }
  void operator()(bool flag) const {
    if (flag) tree[name] = true;
  }
};

std::string quoted(const std::string& text) {
  const auto is_plain = [](unsigned char c) {
    return std::isalnum(c) || std::string_view("_-+=./,:@%").find(char(c)) != std::string_view::npos;
  };
  if (!text.empty() && std::ranges::all_of(text, is_plain)) return text;
  std::string result = "'";
  for (const char c : text) result += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return result + "'";
}

struct ToCommand {
  const char* option;
  std::string& command;

  void add(const std::string& value) const { command += fmt::format(" {} {}", option, quoted(value)); }
  void operator()(const std::optional<double>& number) const {
    if (number) add(fmt::format("{}", *number));
  }
  void operator()(const std::optional<std::string>& text) const {
    if (text) add(*text);
  }
  void operator()(const std::string& text) const {
    if (!text.empty()) add(text);
  }
  void operator()(const std::vector<std::string>& texts) const {
    for (const auto& text : texts) add(text);
  }
  void operator()(bool flag) const {
    if (flag) command += fmt::format(" {}", option);
  }
};

std::string named_table(const Json& table, const TableItem& table_item) {
  if (table.is_number_integer() && table >= 0) return path_text(table_item(table.get<std::size_t>()));
  const auto shipped = shipped_tables();
  std::string names;
  for (const auto& [identifier, file] : shipped) names += (names.empty() ? "" : ", ") + identifier;
  if (table.is_string()) {
    auto identifier = table.get<std::string>();
    if (identifier.empty() || shipped.contains(identifier)) return identifier;
  }
  throw UserError(fmt::format(
      "The setting table is the identifier of a table that comes with the program ({}), or the number of an item.",
      names));
}

}  // namespace

ExtractOptions options_of_settings(const Json& settings) {
  if (!settings.is_object()) throw UserError("The settings are no object.");
  ExtractOptions options;
  for (const auto& [name, value] : settings.items()) {
    const auto setting = std::ranges::find(all(), name, &Setting::name);
    if (setting == all().end()) throw UserError(fmt::format("There is no setting {}.", one_line(name, 60)));
    if (!value.is_null()) visit(*setting, options, FromJson{*setting, value});
  }
  options.table = path_of_text(options.table).string();
  check_measuring_options(options.measuring);
  return options;
}

ExtractOptions extract_options(const Json& settings, const TableItem& table_item) {
  if (!settings.is_object()) throw UserError("The settings are no object.");
  Json resolved = settings;
  if (settings.contains("table") && !settings["table"].is_null())
    resolved["table"] = named_table(settings["table"], table_item);
  return options_of_settings(resolved);
}

Json all_settings(const ExtractOptions& given) {
  ExtractOptions options = given;
  options.table = path_text(given.table);
  Json tree = Json::object();
  for (const Setting& setting : all()) visit(setting, options, ToJson{setting.name, tree});
  return tree;
}

std::string extract_command(const ExtractOptions& options, const std::filesystem::path& recording) {
  std::string command = "rheocyte extract " + quoted(recording.string());
  for (const Setting& setting : all()) visit(setting, options, ToCommand{setting.option, command});
  return command;
}

std::string moduli_command(const ExtractOptions& options, const std::filesystem::path& recording,
                           const std::filesystem::path& table) {
  std::string command = "rheocyte moduli " + quoted(recording.string()) + " --table " + quoted(table.string());
  for (const Setting& setting : all())
    if (!std::holds_alternative<std::string E::*>(setting.member) && !std::holds_alternative<bool E::*>(setting.member))
      visit(setting, options, ToCommand{setting.option, command});
  return command;
}

}  // namespace rheocyte

#include "events/setting.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "case/joined.h"
#include "case/user_error.h"

namespace rheocyte {

namespace {

constexpr std::string_view tube_word = "tube", square_word = "square";

struct Taking {
  const Setting& setting;
  const SettingValue& value;
  const std::string& what;

  [[noreturn]] void refuse(std::string_view wanted) const {
    throw UserError(fmt::format("{} must be {}.", what, wanted));
  }
  void check_filled(std::string_view text) const {
    if (text.find_first_not_of(" \t\r\n") == std::string_view::npos)
      throw UserError(fmt::format("{} is empty; give a value, or leave it out.", what));
  }
  template <class Kind>
  const Kind& as(std::string_view wanted) const {
    if (const Kind* const kind = std::get_if<Kind>(&value)) return *kind;
    refuse(wanted);
  }

  double inside(double given) const {
    if (!setting.range.contains(given))
      throw UserError(fmt::format("{} {:g} is outside its range {} ({}).", what, given,
                                  range_text(setting.range, setting.unit), setting.sentence));
    return given;
  }

  void operator()(std::optional<double>* number) const { *number = inside(as<double>("a number")); }
  void operator()(double* number) const { *number = inside(as<double>("a number")); }
  void operator()(std::vector<double>* numbers) const {
    *numbers = as<std::vector<double>>("a list of numbers");
    for (const double number : *numbers) inside(number);
  }
  void operator()(std::string* text) const {
    const auto* const number = std::get_if<double>(&value);
    *text = number ? fmt::format("{}", *number) : as<std::string>("a text");
    check_filled(*text);
  }
  void operator()(std::optional<std::string>* text) const { (*this)(&text->emplace()); }
  void operator()(std::vector<std::string>* texts) const {
    *texts = as<std::vector<std::string>>("a list of texts");
    for (const std::string& text : *texts) check_filled(text);
  }
  void operator()(std::optional<Section>* section) const {
    const auto* const word = std::get_if<std::string>(&value);
    if (!word || (*word != tube_word && *word != square_word)) refuse("tube or square");
    *section = *word == square_word ? Section::square : Section::tube;
  }
  void operator()(bool* flag) const { *flag = as<bool>("true or false"); }
};

struct Reading {
  using Found = std::optional<SettingValue>;
  template <class Value>
  Found operator()(const std::optional<Value>* value) const {
    return *value ? Found(**value) : std::nullopt;
  }
  Found operator()(const std::optional<Section>* section) const {
    if (!*section) return {};
    return std::string(**section == Section::square ? square_word : tube_word);
  }
  Found operator()(const bool* flag) const { return *flag ? Found(true) : std::nullopt; }
  Found operator()(const double* number) const { return std::isnan(*number) ? std::nullopt : Found(*number); }
  template <class Value>
  Found operator()(const Value* value) const {
    return value->empty() ? std::nullopt : Found(*value);
  }
};

/// Of places that have a value before one is given.
struct OwnValue {
  std::string operator()(const double* number) const { return std::isnan(*number) ? "" : fmt::format("{:g}", *number); }
  std::string operator()(const std::vector<double>* numbers) const {
    return fmt::format("{:g}", fmt::join(*numbers, ", "));
  }
  std::string operator()(const std::vector<std::string>* texts) const { return joined(*texts, ", "); }
  template <class Value>
  std::string operator()(const Value*) const {
    return {};
  }
};

}  // namespace

std::string option_of(const Setting& setting) {
  std::string option = "--" + std::string(setting.name);
  std::ranges::replace(option, '_', '-');
  return option;
}

std::string description_of(const Setting& setting) {
  std::string text(setting.sentence);
  if (std::isfinite(setting.range.greatest)) text += fmt::format(" ({})", range_text(setting.range, setting.unit));
  const std::string otherwise = default_of(setting);
  return otherwise.empty() ? text : fmt::format("{}; default: {}", text, otherwise);
}

std::string default_of(const Setting& setting) {
  if (!setting.otherwise.empty()) return std::string(setting.otherwise);
  return std::visit([](const auto* place) { return OwnValue()(place); }, setting.place);
}

void take(const Setting& setting, const SettingValue& value, const std::string& what) {
  std::visit(Taking{setting, value, what}, setting.place);
}

std::optional<SettingValue> value_of(const Setting& setting) {
  return std::visit([](const auto* place) { return Reading()(place); }, setting.place);
}

}  // namespace rheocyte

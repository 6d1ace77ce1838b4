#include "case/key_value.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include "case/nearest_name.h"

namespace rheocyte {

namespace {

constexpr std::array<std::string_view, 3> parts_of_spread{".mean", ".sd", ".distribution"};
constexpr std::size_t max_word_bytes = 100;

std::string with_meaning(const std::string& allowed, const KeyDescription& key) {
  return fmt::format("{} ({})", allowed, key.sentence);
}

double checked_number(const KeyDescription& key, const Number& number, const GivenKey& given) {
  const auto* value = std::get_if<double>(&given.value);
  if (!value)
    refuse(given,
           fmt::format("{} is not a number; it can be {}.", stated(given), with_meaning(allowed_values(key), key)));
  const auto allowed = with_meaning(range_text(number.range, key.unit), key);
  if (!std::isfinite(*value)) refuse(given, fmt::format("{} is not finite; it can be {}.", stated(given), allowed));
  if (!number.range.contains(*value)) refuse(given, fmt::format("{} is outside its range {}.", stated(given), allowed));
  if (number.is_whole && *value != std::floor(*value))
    refuse(given, fmt::format("{} is not a whole number; it can be {}.", stated(given), allowed));
  return *value;
}

int checked_option(const std::vector<std::string_view>& options, const std::string& allowed, const GivenKey& given) {
  const auto* word = std::get_if<std::string>(&given.value);
  if (!word) refuse(given, fmt::format("{} must be a word: {}.", stated(given), allowed));
  const auto found = std::ranges::find(options, *word);
  if (found != options.end()) return static_cast<int>(found - options.begin());
  const auto hint = did_you_mean(*word, options);
  refuse(given, fmt::format("{} is not known; it can be {}{}", stated(given), allowed, hint.empty() ? "." : hint));
}

std::vector<double> checked_list(const KeyDescription& key, const List& list, const GivenKey& given) {
  const auto* values = std::get_if<std::vector<double>>(&given.value);
  const auto what = with_meaning(allowed_values(key), key);
  if (!values)
    refuse(given, fmt::format("{} is not a list of numbers, for example [0, 60]; it can be {}.", stated(given), what));
  for (const double value : *values)
    if (!list.range.contains(value))
      refuse(given, fmt::format("{} contains {}, which is outside its range; it can be {}.", given.key, value, what));
  if (list.is_ascending && std::ranges::adjacent_find(*values, std::greater_equal<>()) != values->end())
    refuse(given, fmt::format("the numbers of {} must ascend; sort them and give each one once.", given.key));
  return *values;
}

std::string checked_word(const KeyDescription& key, const GivenKey& given) {
  const auto* word = std::get_if<std::string>(&given.value);
  if (!word) refuse(given, fmt::format("{} must be a word ({}).", stated(given), key.sentence));
  if (word->size() > max_word_bytes)
    refuse(given, fmt::format("{} is longer than {} bytes ({}).", stated(given), max_word_bytes, key.sentence));
  return *word;
}

}  // namespace

std::span<const std::string_view> spread_parts() { return parts_of_spread; }

void refuse(const GivenKey& given, const std::string& reason) {
  throw KeyError(given.key, fmt::format("{}: {}", given.where, reason));
}

std::string stated(const GivenKey& given) { return fmt::format("{} = {}", one_line(given.key, 80), value_text(given)); }

Value checked_value(const KeyDescription& key, const GivenKey& given) {
  if (const auto* number = std::get_if<Number>(&key.kind)) return checked_number(key, *number, given);
  if (const auto* list = std::get_if<List>(&key.kind)) return checked_list(key, *list, given);
  if (const auto* choice = std::get_if<Choice>(&key.kind))
    return checked_option(choice->options, allowed_values(key), given);
  return checked_word(key, given);
}

Spread checked_spread(const KeyDescription& key, std::span<const GivenKey> parts) {
  const Range& range = std::get<Scatter>(key.kind).range;
  const auto part = [&](std::string_view suffix) {
    const auto found = std::ranges::find_if(
        parts, [&](const GivenKey& given) { return given.key == std::string(key.name).append(suffix); });
    return found == parts.end() ? nullptr : &*found;
  };
  const auto *plain = part(""), *mean = part(".mean"), *deviation = part(".sd"), *law = part(".distribution");
  const Value* usual = fallback_of(key);
  if (!plain && !mean && !usual)
    refuse(parts.front(), fmt::format("{} also needs {}.mean.", parts.front().key, key.name));
  Spread spread;
  spread.mean = plain || mean ? checked_number(key, {range}, plain ? *plain : *mean) : std::get<Spread>(*usual).mean;
  if (deviation) spread.deviation = checked_number(key, {{0, range.greatest}}, *deviation);
  if (law)
    spread.law = static_cast<Spread::Law>(checked_option({"normal", "lognormal"}, "\"normal\" or \"lognormal\"", *law));
  return spread;
}

}  // namespace rheocyte

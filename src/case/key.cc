#include "case/key.h"

#include <fmt/format.h>

#include <algorithm>

#include "case/joined.h"

namespace rheocyte {

const KeyDescription* find_key(const KeyList& keys, std::string_view name) {
  const auto found = std::ranges::find(keys, name, &KeyDescription::name);
  return found == keys.end() ? nullptr : *found;
}

bool is_required(const KeyDescription& key, const KeyList& keys) {
  const auto* other = find_key(keys, key.alternative);
  return std::holds_alternative<Required>(key.fallback) &&
         (!other || std::holds_alternative<Required>(other->fallback));
}

std::string_view option_of(const KeyDescription& choice, const Value& value) {
  return std::get<Choice>(choice.kind).options[static_cast<std::size_t>(std::get<int>(value))];
}

std::string condition_text(const Condition& condition) {
  if (condition.option.empty()) return fmt::format("{} {}", condition.negated ? "without" : "with", condition.key);
  return fmt::format("for {} {} \"{}\"", condition.key, condition.negated ? "other than" : "=", condition.option);
}

std::string short_number(double value) {
  std::string text = fmt::format("{:g}", value);
  const auto exponent = text.find('e');
  if (exponent == std::string::npos) return text;
  const bool negative = text[exponent + 1] == '-';
  return text.substr(0, exponent) + (negative ? "e-" : "e") + text.substr(text.find_first_not_of("0+-", exponent + 1));
}

std::string range_text(const Range& range, std::string_view unit) {
  return fmt::format("{} .. {}{}{}", short_number(range.least), short_number(range.greatest), unit.empty() ? "" : " ",
                     unit);
}

std::string allowed_values(const KeyDescription& key) {
  if (const auto* number = std::get_if<Number>(&key.kind))
    return range_text(number->range, key.unit) + (number->is_whole ? ", a whole number" : "");
  if (const auto* list = std::get_if<List>(&key.kind)) return "a list of numbers " + range_text(list->range, key.unit);
  if (const auto* spread = std::get_if<Scatter>(&key.kind))
    return fmt::format("a number in {}, or {{mean = ..., sd = ..., distribution = \"normal\" or \"lognormal\"}}",
                       range_text(spread->range, key.unit));
  if (std::holds_alternative<Word>(key.kind)) return "a short text";
  return fmt::format("\"{}\"", joined(std::get<Choice>(key.kind).options, "\" or \""));
}

std::string value_text(const KeyDescription& key, const Value& value) {
  if (std::holds_alternative<int>(value)) return fmt::format("\"{}\"", option_of(key, value));
  if (const auto* word = std::get_if<std::string>(&value)) return fmt::format("\"{}\"", *word);
  if (const auto* list = std::get_if<std::vector<double>>(&value)) return fmt::format("[{}]", joined(*list, ", "));
  if (const auto* spread = std::get_if<Spread>(&value)) return short_number(spread->mean);
  return short_number(std::get<double>(value));
}

}  // namespace rheocyte

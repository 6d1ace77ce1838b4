#include "case/given_keys.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "case/case_text.h"
#include "case/parsed_toml.h"
#include "case/user_error.h"
#include "numeric/number_from_chars.h"

namespace rheocyte {

namespace {

constexpr std::size_t longest_value = 60;

std::string name_of_type(const toml::node& node) {
  switch (node.type()) {
    case toml::node_type::boolean: return node.value_or(false) ? "true" : "false";
    case toml::node_type::array: return node.is_array_of_tables() ? "an array of sections" : "an array";
    case toml::node_type::table: return "a section";
    default: return "a date or time";
  }
}

// 0 for -0: written as an integer, a negative zero would come back as another number.
double one_zero(double number) { return number + 0.0; }

// Nothing unless every element is a number.
std::optional<std::vector<double>> numbers_of(const toml::node& node) {
  const auto* array = node.as_array();
  if (!array || array->empty()) return {};
  std::vector<double> numbers;
  for (const auto& element : *array) {
    if (!element.is_number()) return {};
    numbers.push_back(one_zero(element.value_or(0.0)));
  }
  return numbers;
}

decltype(GivenKey::value) value_of(const toml::node& node) {
  if (const auto number = node.value_exact<double>()) return one_zero(*number);
  if (const auto integer = node.value_exact<int64_t>()) return static_cast<double>(*integer);
  if (const auto text = node.value_exact<std::string>()) return *text;
  if (const auto numbers = numbers_of(node)) return *numbers;
  return Unusable{name_of_type(node)};
}

void collect(const toml::table& table, const std::string& prefix, const std::string& name,
             std::vector<GivenKey>& keys) {
  for (const auto& [key, node] : table) {
    const std::string full = prefix + std::string(key.str());
    const auto* section = node.as_table();
    if (section && !section->empty()) {
      collect(*section, full + ".", name, keys);
    } else {
      // A section header has its source at the table, a value at the node itself; both know the line.
      keys.push_back({full, fmt::format("{}:{}", name, node.source().begin.line), value_of(node)});
    }
  }
}

std::string_view trim(std::string_view text) {
  const auto first = text.find_first_not_of(" \t");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

std::string_view without_quotes(std::string_view text) {
  const bool quoted = text.size() >= 2 && text.front() == text.back() && (text.front() == '"' || text.front() == '\'');
  return quoted ? text.substr(1, text.size() - 2) : text;
}

// The whole text as a number.
std::optional<double> as_number(std::string_view text) {
  double number = 0;
  const auto* start = text.data() + (text.starts_with('+') ? 1 : 0);
  const auto [end, error] = number_from_chars(start, text.data() + text.size(), number);
  if (error != std::errc{} || end != text.data() + text.size()) return {};
  return one_zero(number);
}

// "[0, 0.5]"; nothing if it is not a list of numbers.
std::optional<std::vector<double>> as_list(std::string_view text) {
  if (!text.starts_with('[') || !text.ends_with(']')) return {};
  text = text.substr(1, text.size() - 2);
  std::vector<double> numbers;
  while (true) {
    const auto comma = text.find(',');
    const auto number = as_number(trim(text.substr(0, comma)));
    if (!number) return {};
    numbers.push_back(*number);
    if (comma == std::string_view::npos) return numbers;
    text.remove_prefix(comma + 1);
  }
}

}  // namespace

std::vector<GivenKey> keys_in_toml(std::string_view text, const std::string& name) {
  std::vector<GivenKey> keys;
  collect(parsed_toml(text, name), "", name, keys);
  // toml++ sorts by name; the user reads from the top.
  const auto line = [&](const GivenKey& given) { return std::stol(given.where.substr(name.size() + 1)); };
  std::stable_sort(keys.begin(), keys.end(), [&](const auto& a, const auto& b) { return line(a) < line(b); });
  return keys;
}

GivenKey key_in_setting(std::string_view setting) {
  const auto equals = setting.find('=');
  const auto key = trim(setting.substr(0, equals));
  if (equals == std::string_view::npos || key.empty())
    throw UserError(fmt::format("--set {}: write key=value, for example --set cell.radius_um=7.66",
                                one_line(setting, longest_value)));
  const auto text = trim(setting.substr(equals + 1));
  GivenKey given{std::string(key), "--set", std::string(without_quotes(text)), true};
  if (const auto number = as_number(text)) given.value = *number;
  if (const auto list = as_list(text)) given.value = *list;
  return given;
}

std::vector<GivenKey> given_keys(std::string_view text, const std::string& name, std::span<const std::string> settings,
                                 const TextKind& kind) {
  check_case_text(text, name, kind);
  auto keys = keys_in_toml(text, name);
  for (const auto& setting : settings) keys.push_back(key_in_setting(setting));
  return keys;
}

namespace {

std::string list_text(const std::vector<double>& list) {
  constexpr std::size_t longest_list = 6;
  std::string text;
  for (std::size_t i = 0; i < std::min(list.size(), longest_list); ++i)
    text += fmt::format("{}{}", i == 0 ? "" : ", ", list[i]);
  return "[" + text + (list.size() > longest_list ? ", ...]" : "]");
}

}  // namespace

std::string value_text(const GivenKey& given) {
  if (const auto* number = std::get_if<double>(&given.value)) return fmt::format("{}", *number);
  if (const auto* text = std::get_if<std::string>(&given.value))
    return fmt::format("\"{}\"", one_line(*text, longest_value));
  if (const auto* list = std::get_if<std::vector<double>>(&given.value)) return list_text(*list);
  return std::get<Unusable>(given.value).what;
}

}  // namespace rheocyte

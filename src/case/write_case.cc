#include "case/write_case.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string_view>
#include <utility>

#include "case/parameters.h"

namespace rheocyte {

namespace {

std::pair<std::string_view, std::string_view> section_and_name(std::string_view key) {
  const auto dot = key.rfind('.');
  return {key.substr(0, dot), key.substr(dot + 1)};
}

// Calls visit(parameter, value) with a double, a word or a list for every parameter that has an effect.
template <class Visitor>
void for_each_value(const Case& c, Visitor&& visit) {
  for (const auto& parameter : parameters()) {
    if (!applies(parameter, c)) continue;
    if (const auto* number = std::get_if<Number>(&parameter.value)) {
      if (const auto value = number->get(c)) visit(parameter, *value);
    } else if (const auto* list = std::get_if<List>(&parameter.value)) {
      Case copy = c;
      if (const auto& values = list->at(copy); !values.empty()) visit(parameter, values);
    } else {
      visit(parameter, chosen_option(c, parameter.key));
    }
  }
}

std::string pointer_of(std::string_view key) {
  std::string pointer = fmt::format("/{}", key);
  for (char& letter : pointer)
    if (letter == '.') letter = '/';
  return pointer;
}

std::string toml_value(double value) { return fmt::format("{}", value); }
std::string toml_value(std::string_view word) { return fmt::format("\"{}\"", word); }
std::string toml_value(const std::vector<double>& list) { return fmt::format("[{}]", fmt::join(list, ", ")); }

}  // namespace

nlohmann::ordered_json to_json(const Case& c) {
  auto json = nlohmann::ordered_json::object();
  for_each_value(c, [&](const Parameter& parameter, const auto& value) {
    json[nlohmann::ordered_json::json_pointer(pointer_of(parameter.key))] = value;
  });
  return json;
}

std::string to_toml(const Case& c, std::span<const std::string_view> left_out) {
  std::string text;
  std::string_view open_section;
  for_each_value(c, [&](const Parameter& parameter, const auto& value) {
    if (std::ranges::find(left_out, parameter.key) != left_out.end()) return;
    const auto [section, name] = section_and_name(parameter.key);
    if (section != open_section) text += fmt::format("{}[{}]\n", text.empty() ? "" : "\n", section);
    open_section = section;
    text += fmt::format("{} = {}\n", name, toml_value(value));
  });
  return text;
}

std::string fingerprint(std::string_view bytes) {
  std::uint64_t hash = 14695981039346656037u;
  for (const char byte : bytes) hash = (hash ^ static_cast<unsigned char>(byte)) * 1099511628211u;
  return fmt::format("{:016x}", hash);
}

std::string case_hash(const Case& c) { return fingerprint(to_toml(c)); }

}  // namespace rheocyte

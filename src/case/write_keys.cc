#include "case/write_keys.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "case/joined.h"

namespace rheocyte {

namespace {

bool applies(const KeyDescription& key, const KeyValues& values) {
  const auto& condition = key.only_for;
  if (!condition) return true;
  const auto other = std::ranges::find(values, condition->key, [](const auto& entry) { return entry.first->name; });
  const bool is_there = other != values.end();
  if (condition->option.empty()) return is_there != condition->negated;
  return is_there && (option_of(*other->first, other->second) == condition->option) != condition->negated;
}

std::string pointer_of(std::string_view key) {
  std::string pointer = fmt::format("/{}", key);
  std::ranges::replace(pointer, '.', '/');
  return pointer;
}

// Calls visit with a double, a word or a list.
template <class Visitor>
void visit_value(const KeyDescription& key, const Value& value, Visitor&& visit) {
  if (std::holds_alternative<int>(value)) return visit(option_of(key, value));
  if (const auto* word = std::get_if<std::string>(&value)) return visit(std::string_view(*word));
  if (const auto* list = std::get_if<std::vector<double>>(&value)) return visit(*list);
  if (const auto* number = std::get_if<double>(&value)) visit(*number);
}

std::string toml_value(double value) { return fmt::format("{}", value); }
std::string toml_value(std::string_view word) { return fmt::format("\"{}\"", word); }
std::string toml_value(const std::vector<double>& list) { return fmt::format("[{}]", joined(list, ", ")); }

}  // namespace

KeyValues with_effect(KeyValues values) {
  const KeyValues all = values;
  std::erase_if(values, [&](const auto& entry) { return !applies(*entry.first, all); });
  return values;
}

nlohmann::ordered_json to_json(const KeyValues& values) {
  auto json = nlohmann::ordered_json::object();
  for (const auto& [key, value] : values) {
    auto& place = json[nlohmann::ordered_json::json_pointer(pointer_of(key->name))];
    visit_value(*key, value, [&](const auto& plain) { place = plain; });
  }
  return json;
}

std::string to_toml(const KeyValues& values, std::span<const std::string_view> left_out) {
  std::string text;
  std::string_view open_section;
  for (const auto& [key, value] : values) {
    if (std::ranges::find(left_out, key->name) != left_out.end()) continue;
    const auto dot = key->name.rfind('.');
    const auto section = key->name.substr(0, dot);
    if (section != open_section) text += fmt::format("{}[{}]\n", text.empty() ? "" : "\n", section);
    open_section = section;
    text.append(key->name.substr(dot + 1)).append(" = ");
    visit_value(*key, value, [&](const auto& plain) { text += toml_value(plain); });
    text += '\n';
  }
  return text;
}

}  // namespace rheocyte

#include "case/toml_json.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "case/parsed_toml.h"
#include "case/user_error.h"

namespace rheocyte {
namespace {

using Json = nlohmann::ordered_json;

Json json_of(const toml::node& node, const std::string& name) {
  if (const auto flag = node.value_exact<bool>()) return *flag;
  if (const auto whole = node.value_exact<int64_t>()) return *whole;
  if (const auto number = node.value_exact<double>()) return *number;
  if (const auto text = node.value_exact<std::string>()) return *text;
  if (const auto* const array = node.as_array()) {
    Json list = Json::array();
    for (const auto& element : *array) list.push_back(json_of(element, name));
    return list;
  }
  const auto* const table = node.as_table();
  if (!table)
    throw UserError(
        fmt::format("{}:{}: a date or time stands where none is expected.", name, node.source().begin.line));
  // toml++ sorts by name; here the order of the file counts.
  std::vector<std::pair<std::string, const toml::node*>> entries;
  for (const auto& [key, value] : *table) entries.emplace_back(std::string(key.str()), &value);
  std::ranges::stable_sort(entries, {}, [](const auto& entry) {
    const auto begin = entry.second->source().begin;
    return std::pair(begin.line, begin.column);
  });
  Json object = Json::object();
  for (const auto& [key, value] : entries) object[key] = json_of(*value, name);
  return object;
}

}  // namespace

Json json_of_toml(std::string_view text, const std::string& name, const TextKind& kind) {
  check_case_text(text, name, kind);
  return json_of(parsed_toml(text, name), name);
}

}  // namespace rheocyte

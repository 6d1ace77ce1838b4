#include "case/keys_in_json.h"

#include <algorithm>
#include <nlohmann/json.hpp>

namespace rheocyte {

namespace {

using Json = nlohmann::ordered_json;

bool is_list_of_numbers(const Json& value) {
  return value.is_array() && !value.empty() && std::ranges::all_of(value, [](const Json& v) { return v.is_number(); });
}

decltype(GivenKey::value) value_of(const Json& value) {
  if (value.is_number()) return value.get<double>();
  if (value.is_string()) return value.get<std::string>();
  if (is_list_of_numbers(value)) return value.get<std::vector<double>>();
  if (value.is_boolean()) return Unusable{value.get<bool>() ? "true" : "false"};
  return Unusable{value.is_array() ? "an array" : "a section"};
}

void collect(const Json& section, const std::string& prefix, const std::string& where, std::vector<GivenKey>& keys) {
  for (const auto& [name, value] : section.items()) {
    if (value.is_object() && !value.empty())
      collect(value, prefix + name + ".", where, keys);
    else if (!value.is_null())
      keys.push_back({prefix + name, where, value_of(value)});
  }
}

}  // namespace

std::vector<GivenKey> keys_in_json(const Json& tree, const std::string& where) {
  std::vector<GivenKey> keys;
  collect(tree, "", where, keys);
  return keys;
}

}  // namespace rheocyte

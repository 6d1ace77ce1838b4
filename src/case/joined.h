// Lists in sentences.
#pragma once
#include <fmt/format.h>

#include <string>
#include <string_view>
#include <vector>

namespace rheocyte {

/// The items with a separator between; fmt::join does the same, and costs seconds in each file that uses it.
template <class Items>
std::string joined(const Items& items, std::string_view separator) {
  std::string text;
  for (const auto& item : items) {
    if (!text.empty()) text += separator;
    text += fmt::format("{}", item);
  }
  return text;
}

/// The keys of a map of names, in their order; the map must outlive them.
template <class Map>
std::vector<std::string_view> names_in(const Map& map) {
  std::vector<std::string_view> names;
  for (const auto& [name, value] : map) names.emplace_back(name);
  return names;
}

}  // namespace rheocyte

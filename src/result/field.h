// What stands under a name in a file that the program writes; the files and their reference are made from lists of it.
#pragma once
#include <nlohmann/json.hpp>
#include <string_view>

namespace rheocyte {

/// A key or a column.
template <class Source, class Value = double>
struct Field {
  std::string_view name;  ///< ends with its unit (case/unit.h)
  std::string_view sentence;
  Value (*value)(const Source&);
};

/// An object with all keys.
template <class List, class Source>
nlohmann::ordered_json object_of(const List& fields, const Source& source) {
  auto json = nlohmann::ordered_json::object();
  for (const auto& field : fields) json[field.name] = field.value(source);
  return json;
}

}  // namespace rheocyte

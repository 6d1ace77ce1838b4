#include "python/objects.h"

#include <cmath>
#include <nlohmann/json.hpp>

namespace rheocyte {

namespace py = pybind11;

py::str python_of(std::string_view text) {
  return py::reinterpret_steal<py::str>(
      PyUnicode_DecodeUTF8(text.data(), static_cast<py::ssize_t>(text.size()), "replace"));
}

py::object python_of(const nlohmann::ordered_json& tree) {
  if (tree.is_object()) {
    py::dict dictionary;
    for (const auto& [name, value] : tree.items()) dictionary[python_of(std::string_view(name))] = python_of(value);
    return dictionary;
  }
  if (tree.is_array()) {
    py::list list;
    for (const auto& value : tree) list.append(python_of(value));
    return list;
  }
  if (tree.is_string()) return python_of(std::string_view(tree.get_ref<const std::string&>()));
  if (tree.is_boolean()) return py::bool_(tree.get<bool>());
  if (tree.is_number_integer()) return py::int_(tree.get<std::int64_t>());
  if (tree.is_number() && std::isfinite(tree.get<double>())) return py::float_(tree.get<double>());
  return py::none();
}

py::object python_of(const ColumnDescription& column, const CellValue& value) {
  if (const auto* const text = std::get_if<std::string>(&value)) return python_of(std::string_view(*text));
  if (const auto* const flag = std::get_if<bool>(&value)) return py::bool_(*flag);
  const double number = std::get<double>(value);
  if (!column.words.empty()) return python_of(std::string_view(cell_text(column, value)));
  if (column.digits == digits_of_counts && std::isfinite(number)) return py::int_(std::llround(number));
  return py::float_(number);
}

}  // namespace rheocyte

// Cases: the declared keys, and values from what a Python program states.
#include <pybind11/numpy.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "case/case_keys.h"
#include "case/case_text.h"
#include "case/key_reference.h"
#include "case/read_case.h"
#include "case/user_error.h"
#include "case/write_case.h"
#include "python/bindings.h"
#include "python/objects.h"

namespace rheocyte {

namespace py = pybind11;

namespace {

using StatedKeys = std::vector<std::pair<std::string, py::object>>;

bool is_list(const py::object& value) {
  return py::isinstance<py::sequence>(value) || py::isinstance<py::array>(value);
}

decltype(GivenKey::value) value_from(const py::object& value) {
  if (py::isinstance<py::bool_>(value)) return Unusable{value.cast<bool>() ? "True" : "False"};
  try {
    if (py::isinstance<py::str>(value)) return value.cast<std::string>();
    if (is_list(value)) return value.cast<std::vector<double>>();
    if (PyNumber_Check(value.ptr()) != 0) return py::float_(value).cast<double>();
  } catch (const py::cast_error&) {
    // a list of something else, or a text that is not Unicode
  } catch (const py::error_already_set&) {
    // a number that is not real
  }
  return Unusable{one_line("of the type " + py::str(py::type::of(value).attr("__name__")).cast<std::string>(), 60)};
}

void add(const StatedKeys& stated, const std::string& where, bool from_set, std::vector<GivenKey>& keys) {
  for (const auto& [key, value] : stated) keys.push_back({key, where, value_from(value), from_set});
}

Case case_from(std::vector<GivenKey> keys, const StatedKeys& replaced, const std::string& name) {
  add(replaced, name, true, keys);
  KeyReading reading(key_list(case_keys()), std::move(keys), name, "case");
  return complete_case(reading);
}

Case case_from_file(const std::filesystem::path& file, const StatedKeys& replaced) {
  return case_from(given_keys(read_case_text(file), file.string()), replaced, file.string());
}

Case case_from_keys(const StatedKeys& stated, const StatedKeys& replaced) {
  const std::string name = "Case";
  std::vector<GivenKey> keys;
  add(stated, name, false, keys);
  return case_from(std::move(keys), replaced, name);
}

/// What a file that has been checked states.
py::list stated_in_file(const std::filesystem::path& file) {
  py::list list;
  for (const auto& given : given_keys(read_case_text(file), file.string())) {
    if (const auto* number = std::get_if<double>(&given.value)) list.append(py::make_tuple(given.key, *number));
    if (const auto* word = std::get_if<std::string>(&given.value)) list.append(py::make_tuple(given.key, *word));
    if (const auto* numbers = std::get_if<std::vector<double>>(&given.value))
      list.append(py::make_tuple(given.key, *numbers));
  }
  return list;
}

py::dict description_of(const KeyDescription& key) {
  py::dict d;
  d["name"] = key.name;
  d["unit"] = key.unit;
  d["sentence"] = key.sentence;
  d["allowed"] = allowed_values(key);
  d["option"] = key.option;
  d["former_name"] = key.former_name;
  const Value* const fallback = fallback_of(key);
  d["default"] = fallback ? py::object(py::str(value_text(key, *fallback))) : py::object(py::none());
  d["condition"] = key.only_for ? condition_text(*key.only_for) : "";
  const bool is_list = std::holds_alternative<List>(key.kind), is_choice = std::holds_alternative<Choice>(key.kind);
  d["type"] = is_list ? "list" : is_choice ? "str" : "float";
  d["options"] = is_choice ? py::object(py::cast(std::get<Choice>(key.kind).options)) : py::object(py::none());
  return d;
}

py::list descriptions() {
  py::list list;
  for (const auto& key : case_keys()) list.append(description_of(key));
  return list;
}

}  // namespace

const Binding bind_cases([](py::module_& module) {
  module.def("case_keys", &descriptions);
  module.def("stated_in_file", &stated_in_file);
  module.def("case_reference", [] { return reference_text(case_reference()); });
  py::class_<Case>(module, "CaseValues")
      .def_static("from_file", &case_from_file)
      .def_static("from_keys", &case_from_keys)
      .def("nested", [](const Case& c) { return python_of(to_json(c)); })
      .def("toml", [](const Case& c) { return to_toml(c); })
      .def("hash", &case_hash)
      .def("is_stationary", [](const Case& c) { return c.time.scheme == TimeScheme::stationary; });
});

}  // namespace rheocyte

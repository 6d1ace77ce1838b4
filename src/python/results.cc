// Solved states.
#include <pybind11/stl.h>

#include <nlohmann/json.hpp>

#include "python/arrays.h"
#include "python/bindings.h"
#include "python/objects.h"
#include "python/result_object.h"

namespace rheocyte {

namespace py = pybind11;

py::dict surface_columns(const Result& result) {
  py::dict columns;
  for (const auto& field : contour_fields()) {
    std::vector<double> values;
    const double unit = dimensionless_one(unit_of(field.name), result.scales);
    for (const auto i : result.state.surface.distinct_rows())
      values.push_back(field.value({result.state.surface, i}) * unit);
    columns[py::str(field.name)] = array_of(std::move(values));
  }
  return columns;
}

namespace {

/// Of a cell in a duct, by the names of the files contour_*.csv.
py::dict outlines(const Result& result) {
  py::dict outlines;
  const double um = result.scales.length_um();
  for (const auto& [name, surface] : result.state.views)
    outlines[py::str(name)] = array_of_points(um * surface.point(surface.distinct_rows(), Eigen::all));
  if (const Eigen::MatrixX2d& closed = result.state.offset_outline; closed.rows() > 0)
    outlines["offset"] = array_of_points(um * closed);
  return outlines;
}

py::dict surface_gradient(const Result& result, std::size_t gradient) {
  const Eigen::MatrixXd& slopes = result.gradients.at(gradient).surface;
  py::dict columns;
  for (Eigen::Index j = 0; j < slopes.cols(); ++j) {
    std::vector<double> values;
    for (const auto i : result.state.surface.distinct_rows()) values.push_back(slopes(i, j));
    columns[py::str(contour_fields()[std::size_t(j)].name)] = array_of(std::move(values));
  }
  return columns;
}

}  // namespace

const Binding bind_results([](py::module_& module) {
  py::class_<Result>(module, "Result")
      .def("numbers", [](const Result& r) { return python_of(to_json(r)); })
      .def("surface", &surface_columns)
      .def("outlines", &outlines)
      .def("surface_gradient", &surface_gradient)
      .def("has_state", [](const Result& r) { return bool(r.state.write_fields); })
      .def("write_fields",
           [](const Result& r, const std::string& path) {
             const py::gil_scoped_release released;
             return r.state.write_fields && r.state.write_fields(path, r.scales);
           })
      .def("status", [](const Result& r) { return name(r.state.outcome.status); });
});

}  // namespace rheocyte

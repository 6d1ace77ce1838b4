// The analytical model of small deformations, and the computation of whole tables.
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>

#include "app/analytic_cell.h"
#include "case/user_error.h"
#include "python/arrays.h"
#include "python/bindings.h"
#include "python/objects.h"

namespace rheocyte {

namespace py = pybind11;

namespace {

AnalyticConditions conditions(const std::optional<double>& width_um, const std::optional<double>& radius_um,
                              double rate_ul_s, double viscosity_mPas, bool square_duct) {
  AnalyticConditions c{.input = {}, .square_duct = square_duct};
  c.input.channel.width_um = width_um;
  c.input.channel.radius_um = radius_um;
  c.input.flow.rate_ul_per_s = rate_ul_s;
  c.input.flow.viscosity_mPas = viscosity_mPas;
  complete(c);
  return c;
}

/// The numbers of `rheocyte analytic cell --json`, and its contour.
py::tuple analytic(const AnalyticConditions& c, double radius_um, const std::optional<double>& young_modulus_kPa,
                   const std::optional<double>& cortex_modulus_mN_per_m, double tension_ratio) {
  const AnalyticCell cell = analytic_cell({c, radius_um, young_modulus_kPa, cortex_modulus_mN_per_m, tension_ratio});
  return py::make_tuple(python_of(to_json(cell)), array_of_points(contour_um(cell)));
}

}  // namespace

const Binding bind_analysis([](py::module_& module) {
  py::class_<AnalyticConditions>(module, "AnalyticConditions").def(py::init(&conditions));
  module.def("analytic", &analytic);
});

}  // namespace rheocyte

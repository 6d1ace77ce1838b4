// What commands that read recordings are asked for.
#include "extract/options.h"

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <string>
#include <vector>

#include "python/bindings.h"

namespace rheocyte {

namespace py = pybind11;

void bind_options(py::module_& module) {
  using M = MeasuringOptions;
  py::class_<M>(module, "MeasuringOptions")
      .def(py::init<>())
      .def_readwrite("channel_width_um", &M::channel_width_um)
      .def_readwrite("flow_rate_ul_s", &M::flow_rate_ul_s)
      .def_readwrite("pixel_size_um", &M::pixel_size_um)
      .def_readwrite("viscosity_mPas", &M::viscosity_mPas)
      .def_readwrite("medium", &M::medium)
      .def_readwrite("viscosity_model", &M::viscosity_model)
      .def_readwrite("temperature", &M::temperature)
      .def_readwrite("temperature_if_missing", &M::temperature_if_missing)
      .def("set_gates", [](M& m, const std::vector<std::string>& min, const std::vector<std::string>& max,
                           const std::vector<std::string>& polygons) {
        m.gates = {min, max, polygons};
      });
  py::class_<ExtractOptions>(module, "ExtractOptions")
      .def(py::init<>())
      .def_readwrite("measuring", &ExtractOptions::measuring)
      .def_readwrite("table", &ExtractOptions::table)
      .def("set_section", [](ExtractOptions& o, bool square) { o.section = square ? Section::square : Section::tube; })
      .def_readwrite("no_pixelation", &ExtractOptions::no_pixelation)
      .def_readwrite("no_asymmetry", &ExtractOptions::no_asymmetry)
      .def_readwrite("no_area_correction", &ExtractOptions::no_area_correction);
  py::class_<ModuliOptions>(module, "ModuliOptions")
      .def(py::init<>())
      .def_readwrite("measuring", &ModuliOptions::measuring)
      .def_readwrite("table", &ModuliOptions::table)
      .def_readwrite("fit_tension", &ModuliOptions::fit_tension)
      .def_readwrite("axial_tension_Pa", &ModuliOptions::axial_tension_Pa)
      .def_readwrite("only_figure", &ModuliOptions::only_figure)
      .def("set_section", [](ModuliOptions& o, bool square) { o.section = square ? Section::square : Section::tube; });
}

}  // namespace rheocyte

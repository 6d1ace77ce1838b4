// What is measured in recordings, and moduli with tension of each.
#include <pybind11/functional.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <filesystem>
#include <string>

#include "extract/moduli_recording.h"
#include "python/bindings.h"
#include "python/contained_reading.h"
#include "python/interruptible.h"

namespace rheocyte {

namespace py = pybind11;

namespace {

// The lines of `rheocyte moduli`, into a file that may be a piece of memory.
std::vector<std::string> moduli(const std::filesystem::path& recording, const std::filesystem::path& target,
                                const ModuliOptions& options, const PythonProgress& progress) {
  check_measuring_options(options.measuring);
  return interruptible([&](const std::atomic<bool>& stop) {
    const ModuliTable table(options);
    const auto work = [&](const TellProgress& tell_progress) {
      return moduli_of_recording(recording, target, options, table, tell_progress).warnings;
    };
    return read_contained(recording, work, progress, stop);
  });
}

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
      .def_readwrite("only_figure", &ModuliOptions::only_figure);
}

}  // namespace

void bind_recordings(py::module_& module) {
  bind_options(module);
  module.def("moduli", &moduli);
}

}  // namespace rheocyte

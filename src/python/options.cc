// What commands that read recordings are asked for.
#include "events/options.h"

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <nlohmann/json.hpp>
#include <string>

#include "events/recording_settings.h"
#include "experiment/plan_settings.h"
#include "python/bindings.h"
#include "python/objects.h"
#include "report/settings_text.h"

namespace rheocyte {

namespace py = pybind11;

namespace {

template <class Options>
py::class_<Options> bind(py::module_& module, const char* name) {
  return py::class_<Options>(module, name)
      .def(py::init<>())
      .def_static("declared",
                  [] {
                    Options none;
                    return python_of(declared_settings(settings_of(none)));
                  })
      .def("take", [](Options& options, const std::string& setting, const SettingValue& value) {
        for (const Setting& one : settings_of(options))
          if (one.name == setting) take(one, value, setting);
      });
}

}  // namespace

const Binding bind_options([](py::module_& module) {
  bind<ExtractOptions>(module, "ExtractOptions");
  bind<ModuliOptions>(module, "ModuliOptions").def_readwrite("table", &ModuliOptions::table);
  bind<TimeCourseOptions>(module, "TimeCourseOptions");
  bind<PopulationOptions>(module, "PopulationOptions");
  bind<PlanOptions>(module, "PlanOptions");
});

}  // namespace rheocyte

// Populations of cells in recordings, and the planning of experiments.
#include <pybind11/functional.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "experiment/experiment_plan.h"
#include "python/bindings.h"
#include "python/interruptible.h"
#include "python/isolated_reading.h"
#include "report/population_json.h"
#include "report/population_tables.h"
#include "store/stop_signal.h"

namespace rheocyte {

namespace py = pybind11;

namespace {

/// Texts of population.json and of the tables of single events, one for each recording.
struct PopulationTexts {
  std::string json;
  std::vector<std::string> events;
};

using NamedRecordings = std::vector<std::pair<std::string, std::vector<std::filesystem::path>>>;

py::tuple population(const NamedRecordings& named, const PopulationOptions& options, const PythonProgress& progress) {
  check_options(options.measuring);
  std::vector<PopulationCondition> conditions;
  std::size_t all = 0, done = 0;
  for (const auto& [name, recordings] : named) {
    conditions.push_back({name, recordings});
    all += recordings.size();
  }
  check_conditions(conditions, options.paired);
  const StiffnessMeasure by = stiffness_measure_of(options);
  const auto texts = interruptible([&](const std::atomic<bool>& stop) -> PopulationTexts {
    PopulationAnalysis analysis(options, conditions);
    for (std::size_t c = 0; c < conditions.size(); ++c)
      for (std::size_t j = 0; j < conditions[c].recordings.size(); ++j, ++done) {
        const auto& file = conditions[c].recordings[j];
        const auto work = [&](const TellProgress& report_progress) {
          return read_population_events(file, options.measuring, by, [&](double fraction) {
            report_progress((double(done) + fraction) / double(all));
          });
        };
        const PopulationEvents events = read_isolated(file, options.measuring, work, progress, stop);
        if (stop) return {};
        try {
          analysis.add(c, j, events, [&stop] {
            if (stop) throw StoppedBySignal{};
          });
        } catch (const StoppedBySignal&) {
          return {};
        }
      }
    const PopulationReport report = analysis.report();
    PopulationTexts made{population_json(report), {}};
    for (const auto& recording : report.recordings) made.events.push_back(population_events_table(recording));
    return made;
  });
  return py::make_tuple(texts.json, texts.events);
}

/// The table of the channels, and what follows from it in sentences.
py::tuple plan(const PlanOptions& options) {
  const auto planned =
      interruptible([&](const std::atomic<bool>&) -> ExperimentPlan { return plan_experiment(options); });
  return py::make_tuple(plan_table(planned), planned.lines);
}

}  // namespace

const Binding bind_populations([](py::module_& module) {
  module.def("population", &population);
  using O = PlanOptions;
  py::class_<O>(module, "PlanOptions")
      .def(py::init<>())
      .def_readwrite("radius_um", &O::radius_um)
      .def_readwrite("young_modulus_kPa", &O::young_modulus_kPa)
      .def_readwrite("spread", &O::spread)
      .def_readwrite("radius_spread", &O::radius_spread)
      .def_readwrite("between_recordings", &O::between_recordings)
      .def_readwrite("difference", &O::difference)
      .def_readwrite("power", &O::power)
      .def_readwrite("cells", &O::cells)
      .def_readwrite("mode_2", &O::mode_2)
      .def_readwrite("pixel_size_um", &O::pixel_size_um)
      .def_readwrite("temperature_C", &O::temperature_C)
      .def_readwrite("widths_um", &O::widths_um)
      .def_readwrite("media", &O::media)
      .def_readwrite("rates_ul_s", &O::rates_ul_s);
  module.def("plan", &plan);
});

}  // namespace rheocyte

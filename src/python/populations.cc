// Populations of cells in recordings, and the planning of experiments.
#include <pybind11/functional.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <nlohmann/json.hpp>

#include "experiment/analyse_populations.h"
#include "experiment/plan_words.h"
#include "python/bindings.h"
#include "python/interruptible.h"
#include "python/objects.h"
#include "python/python_watch.h"
#include "report/plan_columns.h"
#include "report/population_columns.h"
#include "report/population_files.h"

namespace rheocyte {

namespace py = pybind11;

namespace {

using NamedRecordings = std::vector<std::pair<std::string, std::vector<std::filesystem::path>>>;

/// The record of population.json, the tables of its rows by their names, and those of single events, one for each
/// recording.
py::tuple population(const NamedRecordings& named, const PopulationOptions& options, const PythonProgress& progress) {
  check_options(options.measuring);
  std::vector<PopulationCondition> conditions;
  for (const auto& [name, recordings] : named) conditions.push_back({name, recordings});
  check_conditions(conditions, options.paired);
  const auto report = interruptible([&](const std::atomic<bool>& stop) -> PopulationReport {
    return analyse(conditions, options, watched_by(progress, stop));
  });
  py::dict tables;
  tables["recordings"] = table_of(recording_columns(report), report.recordings);
  tables["conditions"] = table_of(condition_columns(report), report.conditions);
  tables["comparisons"] = table_of(comparison_columns(report), report.comparisons);
  tables["checks"] = table_of(check_row_columns(), check_rows(report));
  py::list events;
  for (const auto& recording : report.recordings)
    events.append(table_of(shrunken_columns(), shrunken_events(recording)));
  return py::make_tuple(python_of(population_record(report)), tables, events);
}

/// The table of the channels, and what follows from it in sentences.
py::tuple plan(const PlanOptions& options) {
  const auto planned =
      interruptible([&](const std::atomic<bool>&) -> ExperimentPlan { return plan_experiment(options); });
  return py::make_tuple(table_of(plan_columns(), planned.channels), plan_lines(options, planned));
}

}  // namespace

const Binding bind_populations([](py::module_& module) {
  module.def("population", &population);
  module.def("plan", &plan);
});

}  // namespace rheocyte

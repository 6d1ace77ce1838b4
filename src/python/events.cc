// Events of a recording with their moduli.
#include <pybind11/functional.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <tuple>
#include <type_traits>

#include "extract/event_pass.h"
#include "extract/extraction.h"
#include "python/bindings.h"
#include "python/contained_reading.h"
#include "python/interruptible.h"
#include "python/shared_columns.h"

namespace rheocyte {

namespace py = pybind11;

namespace {

struct Events {
  std::vector<double> area, deformation, viscosity, modulus, standard_error;
  std::vector<std::int8_t> state, elongated;
  std::vector<double> shape_excess, shape_excess_error, odd_share, mode_3;
  std::vector<ElongationColumn> elongation_columns;
  std::vector<std::vector<double>> elongation;  ///< column by column
  std::vector<OutlineTilt> tilt;
  ExtractSummary summary;
  std::vector<std::string> lines;

  void append(const EventBlock& b) {
    const auto add = [](std::vector<double>& to, std::span<const double> from) {
      to.insert(to.end(), from.begin(), from.end());
    };
    add(area, b.area_um2);
    add(deformation, b.deformation);
    add(viscosity, b.viscosity_mPas);
    add(modulus, b.young_modulus_kPa);
    add(standard_error, b.standard_error_kPa);
    std::ranges::transform(b.state, std::back_inserter(state), [](ModulusState s) { return std::int8_t(s); });
    for (const ShapeExcess& shape : b.shape) {
      shape_excess.push_back(shape.excess);
      shape_excess_error.push_back(shape.error);
      elongated.push_back(shape.is_elongated() ? 1 : 0);
      odd_share.push_back(shape.odd_share);
    }
    add(mode_3, b.mode_3);
    elongation.resize(elongation_columns.size());
    for (std::size_t k = 0; k < elongation.size(); ++k) add(elongation[k], b.elongation.*elongation_columns[k].values);
    tilt.insert(tilt.end(), b.tilt.begin(), b.tilt.end());
  }
};

Events events_of(const std::filesystem::path& file, const ExtractOptions& options, const TellProgress& tell_progress) {
  const ModulusTables tables(options.table, options.section);
  Recording recording(file);
  EventPass pass(recording, tell_progress);
  Extraction extraction(recording, options, tables);
  Events events;
  if (const auto by = extraction.event_shapes().elongated_by()) events.elongation_columns = elongation_columns(*by);
  pass.in_blocks(extraction.block(),
                 [&](std::size_t first, std::size_t count) { events.append(extraction.compute(first, count)); });
  events.summary = extraction.summary();
  events.lines = extraction.lines();
  return events;
}

/// What is said about the columns.
struct Told {
  std::uint64_t events = 0;
  std::vector<SharedColumn> columns;
  std::vector<std::string> shapes, settings, warnings;
  std::string table;

  /// For store/bytes.h.
  template <class Self>
  static auto fields(Self& s) {
    return std::tie(s.events, s.columns, s.shapes, s.settings, s.warnings, s.table);
  }
};

Told written(const Events& e, const SharedColumns& memory) {
  Told told{e.area.size(), {}, shape_lines(e.summary.shapes), e.lines, e.summary.warnings, e.summary.table};
  const auto write = [&](const char* name, const auto& values) {
    constexpr bool is_bytes = std::is_same_v<decltype(values), const std::vector<std::int8_t>&>;
    memory.write(values);
    told.columns.push_back({name, is_bytes});
  };
  write("area_um2", e.area);
  write("deformation", e.deformation);
  write("viscosity_mPas", e.viscosity);
  write("young_modulus_kPa", e.modulus);
  write("standard_error_kPa", e.standard_error);
  write("state", e.state);
  if (std::isfinite(e.summary.shapes.excess.value)) {
    write("shape_excess", e.shape_excess);
    write("shape_excess_error", e.shape_excess_error);
    write("elongated", e.elongated);
    write("odd_share", e.odd_share);
  }
  for (std::size_t k = 0; k < e.elongation.size(); ++k) write(e.elongation_columns[k].name.c_str(), e.elongation[k]);
  if (!e.mode_3.empty()) {
    write("mode_3", e.mode_3);
    std::vector<double> values(e.tilt.size());
    for (const TiltFeature& feature : tilt_features()) {
      std::ranges::transform(e.tilt, values.begin(), feature.value);
      write(feature.name, values);
    }
  }
  return told;
}

py::tuple extract(const std::filesystem::path& file, const ExtractOptions& options, const PythonProgress& progress) {
  check_options(options);
  const SharedColumns memory;
  const auto work = [&](const TellProgress& tell_progress) {
    return written(events_of(file, options, tell_progress), memory);
  };
  const Told told = interruptible(
      [&](const std::atomic<bool>& stop) { return read_contained(file, options.measuring, work, progress, stop); });
  py::dict attributes;
  attributes["shapes"] = told.shapes;
  attributes["table"] = told.table;
  attributes["settings"] = told.settings;
  attributes["warnings"] = told.warnings;
  return py::make_tuple(memory.arrays(told.columns, told.events), attributes);
}

}  // namespace

void bind_events(py::module_& module) { module.def("extract", &extract); }

}  // namespace rheocyte

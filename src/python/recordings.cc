// Recordings and masks: events with their moduli, and features of outlines.
#include <pybind11/functional.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "case/user_error.h"
#include "extract/extraction.h"
#include "extract/moduli_recording.h"
#include "extract/time_course_table.h"
#include "measurement/contour_features.h"
#include "measurement/contour_from_mask.h"
#include "measurement/shape_in_pixels.h"
#include "numeric/no_value.h"
#include "python/arrays.h"
#include "python/bindings.h"
#include "python/interruptible.h"
#include "shape/radius_modes.h"
#include "store/build_info.h"
#include "store/whole_file.h"
#include "synth/synth_shapes.h"
#include "synth/virtual_recording.h"

namespace rheocyte {

namespace py = pybind11;

namespace {

using Progress = std::optional<std::function<void(double)>>;

void tell(const Progress& progress, double share) {
  if (!progress) return;
  const py::gil_scoped_acquire acquired;
  (*progress)(share);
}

struct Events {
  std::vector<double> area, deformation, viscosity, modulus, standard_error;
  std::vector<std::int8_t> state, elongated;
  std::vector<double> shape_excess, shape_excess_error, odd_share, mode_3, asymmetry, asymmetry_error;
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
    add(asymmetry, b.asymmetry_kPa);
    add(asymmetry_error, b.asymmetry_error_kPa);
  }
};

Events events_of(const std::filesystem::path& file, const ExtractOptions& options, const Progress& progress,
                 const std::atomic<bool>& stop) {
  const ModulusTables tables(options.table, options.section);
  const Recording recording(file);
  Extraction extraction(recording, options, tables);
  Events events;
  const std::size_t all = recording.events(), block = extraction.block();
  for (std::size_t first = 0; first < all && !stop; first += block) {
    const std::size_t count = std::min(block, all - first);
    events.append(extraction.compute(first, count));
    tell(progress, static_cast<double>(first + count) / static_cast<double>(all));
  }
  events.summary = extraction.summary();
  events.lines = extraction.lines();
  return events;
}

py::tuple extract(const std::filesystem::path& file, const ExtractOptions& options, const Progress& progress) {
  check_measuring_options(options.measuring);
  Events e = interruptible([&](const std::atomic<bool>& stop) { return events_of(file, options, progress, stop); });
  py::dict columns, attributes;
  columns["area_um2"] = array_of(std::move(e.area));
  columns["deformation"] = array_of(std::move(e.deformation));
  columns["viscosity_mPas"] = array_of(std::move(e.viscosity));
  columns["young_modulus_kPa"] = array_of(std::move(e.modulus));
  columns["standard_error_kPa"] = array_of(std::move(e.standard_error));
  columns["state"] = array_of(std::move(e.state));
  if (std::isfinite(e.summary.shapes.excess.value)) {
    columns["shape_excess"] = array_of(std::move(e.shape_excess));
    columns["shape_excess_error"] = array_of(std::move(e.shape_excess_error));
    columns["elongated"] = array_of(std::move(e.elongated));
    columns["odd_share"] = array_of(std::move(e.odd_share));
  }
  if (!e.mode_3.empty()) {
    columns["mode_3"] = array_of(std::move(e.mode_3));
    columns["young_modulus_asymmetry_kPa"] = array_of(std::move(e.asymmetry));
    columns["standard_error_asymmetry_kPa"] = array_of(std::move(e.asymmetry_error));
  }
  attributes["shapes"] = shape_lines(e.summary.shapes);
  attributes["table"] = e.summary.table;
  attributes["settings"] = e.lines;
  attributes["warnings"] = e.summary.warnings;
  return py::make_tuple(columns, attributes);
}

// The lines of `rheocyte moduli`, into a file that may be a piece of memory.
std::vector<std::string> moduli(const std::filesystem::path& recording, const std::filesystem::path& target,
                                const ModuliOptions& options, const Progress& progress) {
  check_measuring_options(options.measuring);
  struct Stopped {};
  return interruptible([&](const std::atomic<bool>& stop) -> std::vector<std::string> {
    try {
      const ModuliTable table(options);
      return moduli_of_recording(recording, target, options, table,
                                 [&](double share) {
                                   tell(progress, share);
                                   if (stop) throw Stopped{};
                                 })
          .warnings;
    } catch (const Stopped&) {
      return {};
    }
  });
}

// The file of `rheocyte time-course` as text, and what it says in sentences; a contraction for each recording.
py::tuple time_course(const std::vector<std::filesystem::path>& recordings, const std::filesystem::path& place,
                      const std::vector<double>& contraction_um, const MeasuringOptions& measuring,
                      const Progress& progress) {
  check_measuring_options(measuring);
  struct Stopped {};
  const auto report = interruptible([&](const std::atomic<bool>& stop) -> CourseReport {
    try {
      const DynamicTable table = read_dynamic_table(place);
      CourseTable courses(table);
      for (std::size_t i = 0; i < recordings.size(); ++i) {
        const auto tell_share = [&](double share) {
          tell(progress, (double(i) + share) / double(recordings.size()));
          if (stop) throw Stopped{};
        };
        courses.add(read_course_events(recordings[i], measuring, tell_share), recordings[i].string(),
                    contraction_um[i]);
      }
      return courses.report();
    } catch (const Stopped&) {
      return {};
    }
  });
  return py::make_tuple(report.text, report.lines);
}

// The file appears whole or not at all; the caller has looked whether one is there. The number of its events.
std::size_t synth(const std::string& text, const std::string& name, const std::vector<std::string>& settings,
                  const std::filesystem::path& place, const Progress& progress) {
  SynthSpec spec = parse_synth_spec(text, name, settings);
  if (!spec.table.empty()) spec.table = std::filesystem::path(name).parent_path() / spec.table;
  const RecordingProvenance provenance{std::string("rheocyte ") + version, text};
  struct Stopped {};
  return interruptible([&](const std::atomic<bool>& stop) -> std::size_t {
    const auto shapes = shapes_of(spec);
    WholeFile file(place);
    try {
      const auto made = write_virtual_recording(spec, *shapes, provenance, file.scratch(), [&](double share) {
        tell(progress, share);
        if (stop) throw Stopped{};
      });
      file.publish();
      return made.events;
    } catch (const Stopped&) {
      return 0;
    }
  });
}

using Masks = py::array_t<std::uint8_t, py::array::c_style>;

struct Found {
  std::vector<ContourFeatures> features;
  std::vector<ShapeVector> shapes;
};

// Masks (events, rows, columns), not empty; the caller has looked.
py::dict features(const Masks& masks, double pixel_size_um) {
  const auto count = static_cast<std::size_t>(masks.shape(0));
  const ImageSize size{static_cast<std::size_t>(masks.shape(2)), static_cast<std::size_t>(masks.shape(1))};
  const std::uint8_t* const pixels = masks.data();
  const auto found = interruptible([&](const std::atomic<bool>& stop) {
    Found all;
    ContourFinder finder;
    ContourMeasurer measurer;
    all.features.reserve(count);
    all.shapes.reserve(count);
    for (std::size_t i = 0; i < count && !stop; ++i) {
      const PixelContour& contour = finder.contour_of({size, {pixels + i * size.pixels(), size.pixels()}});
      all.features.push_back(measurer.measure(contour, pixel_size_um));
      const bool is_cell = std::isfinite(all.features.back().area_um2);
      all.shapes.push_back(is_cell ? shape_of_hull(measurer.hull(), pixel_size_um) : ShapeVector::Constant(no_value));
    }
    return all;
  });
  py::dict columns;
  for (const OutlineFeature& feature : outline_features()) {
    std::vector<double> values(count);
    std::ranges::transform(found.features, values.begin(), feature.value);
    columns[feature.name] = array_of(std::move(values));
  }
  for (int k = first_radius_mode; k <= last_radius_mode; ++k) {
    std::vector<double> values(count);
    const int row = int(ShapeFeature::first_mode) + k - min_mode;
    std::ranges::transform(found.shapes, values.begin(), [row](const ShapeVector& shape) { return shape(row); });
    columns[("mode_" + std::to_string(k)).c_str()] = array_of(std::move(values));
  }
  return columns;
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
      .def("set_gates", [](M& m, const std::vector<std::string>& least, const std::vector<std::string>& greatest,
                           const std::vector<std::string>& polygons) {
        m.gates = {least, greatest, polygons};
      });
  py::class_<ExtractOptions>(module, "ExtractOptions")
      .def(py::init<>())
      .def_readwrite("measuring", &ExtractOptions::measuring)
      .def_readwrite("table", &ExtractOptions::table)
      .def("set_square", [](ExtractOptions& o) { o.section = Section::square; })
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
  module.def("extract", &extract);
  module.def("moduli", &moduli);
  module.def("time_course", &time_course);
  module.def("features", &features);
  module.def("synth", &synth);
}

}  // namespace rheocyte

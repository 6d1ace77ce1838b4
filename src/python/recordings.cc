// Recordings and masks: events with their moduli, and features of outlines.
#include <pybind11/functional.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <tuple>
#include <type_traits>

#include "case/user_error.h"
#include "extract/event_pass.h"
#include "extract/extraction.h"
#include "extract/moduli_recording.h"
#include "extract/time_course_table.h"
#include "measurement/contour_features.h"
#include "measurement/contour_from_mask.h"
#include "numeric/no_value.h"
#include "python/arrays.h"
#include "python/bindings.h"
#include "python/contained_reading.h"
#include "python/interruptible.h"
#include "python/shared_columns.h"
#include "shape/outline_shape.h"
#include "shape/radius_modes.h"
#include "store/build_info.h"
#include "store/whole_file.h"
#include "synth/synth_shapes.h"
#include "synth/virtual_recording.h"

namespace rheocyte {

namespace py = pybind11;

namespace {

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

Events events_of(const std::filesystem::path& file, const ExtractOptions& options, const TellProgress& tell_progress) {
  const ModulusTables tables(options.table, options.section);
  Recording recording(file);
  EventPass pass(recording, tell_progress);
  Extraction extraction(recording, options, tables);
  Events events;
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
  if (!e.mode_3.empty()) {
    write("mode_3", e.mode_3);
    write("young_modulus_asymmetry_kPa", e.asymmetry);
    write("standard_error_asymmetry_kPa", e.asymmetry_error);
  }
  return told;
}

py::tuple extract(const std::filesystem::path& file, const ExtractOptions& options, const PythonProgress& progress) {
  check_measuring_options(options.measuring);
  const SharedColumns memory;
  const auto work = [&](const TellProgress& tell_progress) {
    return written(events_of(file, options, tell_progress), memory);
  };
  const Told told =
      interruptible([&](const std::atomic<bool>& stop) { return read_contained(file, work, progress, stop); });
  py::dict attributes;
  attributes["shapes"] = told.shapes;
  attributes["table"] = told.table;
  attributes["settings"] = told.settings;
  attributes["warnings"] = told.warnings;
  return py::make_tuple(memory.arrays(told.columns, told.events), attributes);
}

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

// The file of `rheocyte time-course` as text, and what it says in sentences; a contraction for each recording.
py::tuple time_course(const std::vector<std::filesystem::path>& recordings, const std::filesystem::path& place,
                      const std::vector<double>& contraction_um, const MeasuringOptions& measuring,
                      const PythonProgress& progress) {
  check_measuring_options(measuring);
  const auto report = interruptible([&](const std::atomic<bool>& stop) -> CourseReport {
    const DynamicTable table = read_dynamic_table(place);
    CourseTable courses(table);
    for (std::size_t i = 0; i < recordings.size(); ++i) {
      const auto work = [&](const TellProgress& tell_progress) {
        return read_course_events(recordings[i], measuring, [&](double share) {
          tell_progress((double(i) + share) / double(recordings.size()));
        });
      };
      const auto events = read_contained(recordings[i], work, progress, stop);
      if (stop) return {};
      courses.add(events, recordings[i].string(), contraction_um[i]);
    }
    return courses.report();
  });
  return py::make_tuple(report.text, report.lines);
}

// The file appears whole or not at all; the caller has looked whether one is there. The number of its events.
std::size_t synth(const std::string& text, const std::string& name, const std::vector<std::string>& settings,
                  const std::filesystem::path& place, const PythonProgress& progress) {
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
  std::vector<RadiusModes> modes;
};

// Names and values (names, events) of masks (events, rows, columns), not empty; the caller has looked.
py::tuple features(const Masks& masks, double pixel_size_um) {
  const auto count = static_cast<std::size_t>(masks.shape(0));
  const ImageSize size{static_cast<std::size_t>(masks.shape(2)), static_cast<std::size_t>(masks.shape(1))};
  const std::uint8_t* const pixels = masks.data();
  const auto found = interruptible([&](const std::atomic<bool>& stop) {
    Found all;
    RadiusModes no_modes;
    no_modes.fill(no_value);
    ContourFinder finder;
    ContourMeasurer measurer;
    all.features.reserve(count);
    all.modes.reserve(count);
    for (std::size_t i = 0; i < count && !stop; ++i) {
      const PixelContour& contour = finder.contour_of({size, {pixels + i * size.pixels(), size.pixels()}});
      all.features.push_back(measurer.measure(contour, pixel_size_um));
      const bool is_cell = std::isfinite(all.features.back().area_um2);
      all.modes.push_back(is_cell ? hull_modes(measurer.hull()) : no_modes);
    }
    return all;
  });
  py::list names;
  py::array_t<double> columns({outline_features().size() + std::tuple_size_v<RadiusModes>, count});
  double* values = columns.mutable_data();
  for (const OutlineFeature& feature : outline_features()) {
    names.append(feature.name);
    values = std::ranges::transform(found.features, values, feature.value).out;
  }
  for (int k = first_radius_mode; k <= last_radius_mode; ++k) {
    names.append("mode_" + std::to_string(k));
    const auto place = std::size_t(k - first_radius_mode);
    values = std::ranges::transform(found.modes, values, [place](const RadiusModes& m) { return m[place]; }).out;
  }
  return py::make_tuple(names, columns);
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
  module.def("extract", &extract);
  module.def("moduli", &moduli);
  module.def("time_course", &time_course);
  module.def("features", &features);
  module.def("synth", &synth);
}

}  // namespace rheocyte

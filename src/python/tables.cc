// Tables of moduli: events in numpy arrays, and lines.
#include <fmt/format.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <algorithm>
#include <array>
#include <memory>
#include <optional>
#include <string>

#include "case/to_path.h"
#include "case/user_error.h"
#include "infer/isoelasticity_lines.h"
#include "infer/map_as_lut.h"
#include "infer/read_modulus_map.h"
#include "infer/shape_map.h"
#include "python/arrays.h"
#include "python/bindings.h"
#include "python/buffer.h"
#include "python/interruptible.h"
#include "report/dclab_plugin.h"
#include "shelf/find_table.h"
#include "shelf/modulus_tables.h"
#include "shelf/shipped_tables.h"
#include "store/own_file.h"

namespace rheocyte {

namespace py = pybind11;

namespace {

using SharedMap = std::shared_ptr<const ModulusMap>;

/// A table that a program holds.
struct HeldTable {
  SharedMap map;
};

// Columns of a block stay in the second fastest memory.
constexpr std::size_t block = 4096;

/// Of numpy, which takes large pages for large arrays and leaves them unwritten.
struct Columns {
  py::array_t<double> modulus_kPa, standard_error_kPa;
  py::array_t<std::int8_t> state;

  explicit Columns(std::size_t events) : modulus_kPa(events), standard_error_kPa(events), state(events) {}
};

struct Estimates {
  std::span<double> modulus_kPa, standard_error_kPa;
  std::span<std::int8_t> state;
};

/// What determines the viscosity of each event, or of all: itself (mPa s), or the temperature (degC) of a buffer.
struct LiquidOfEvents {
  const Buffer* buffer;
  std::span<const double> values;

  void viscosities(const ChannelFlow& flow, std::span<const double> part, std::span<double> mPas) const {
    if (buffer)
      viscosities_at(*buffer, flow, part, mPas);
    else
      std::ranges::copy(part, mPas.begin());
  }
};

void estimate(const ModulusMap& map, const MeasuringConditions& conditions, const MeasuredEvents& events,
              const LiquidOfEvents& liquid, const Estimates& found, const std::atomic<bool>& stop) {
  const std::size_t all = events.size.size();
  std::array<ModulusState, block> states{};
  std::array<double, block> viscosity{};
  const bool is_one = liquid.values.size() == 1;
  if (is_one) {
    liquid.viscosities(conditions.flow, liquid.values, std::span(viscosity).first(1));
    viscosity.fill(viscosity.front());
  }
  for (std::size_t first = 0; first < all && !stop; first += block) {
    const std::size_t count = std::min(block, all - first);
    if (!is_one)
      liquid.viscosities(conditions.flow, liquid.values.subspan(first, count), std::span(viscosity).first(count));
    map.estimate(conditions,
                 {events.size.subspan(first, count), events.deformation.subspan(first, count),
                  std::span(viscosity).first(count)},
                 {found.modulus_kPa.subspan(first, count), found.standard_error_kPa.subspan(first, count),
                  std::span(states).first(count)});
    std::ranges::transform(std::span(states).first(count), found.state.begin() + static_cast<std::ptrdiff_t>(first),
                           [](ModulusState state) { return static_cast<std::int8_t>(state); });
  }
}

MeasuringConditions measuring_conditions(double width_um, double rate_ul_s, double pixel_size_um, bool correct_area) {
  return {{.width_um = width_um, .rate_ul_s = rate_ul_s}, pixel_size_um, correct_area};
}

// The arrays are equally long (or `liquid` is a single number, see LiquidOfEvents): the caller has looked.
py::tuple modulus(const HeldTable& table, const Numbers& area, const Numbers& deformation, const Numbers& liquid,
                  const Buffer* buffer, const MeasuringConditions& conditions) {
  const MeasuredEvents events{span_of(area), span_of(deformation), {}};
  Columns columns(events.size.size());
  const Estimates found{span_to_fill(columns.modulus_kPa), span_to_fill(columns.standard_error_kPa),
                        span_to_fill(columns.state)};
  interruptible([&](const std::atomic<bool>& stop) {
    estimate(*table.map, conditions, events, {buffer, span_of(liquid)}, found, stop);
    return 0;
  });
  return py::make_tuple(columns.modulus_kPa, columns.standard_error_kPa, columns.state);
}

py::array_t<double> seen(const ModulusMap& map, const MeasuringConditions& conditions,
                         std::span<const PlanePoint> points) {
  return array_of_points(as_measured(points, map.origin().flow, conditions, &map), &PlanePoint::x, &PlanePoint::y);
}

// Inertia ratios against those of the table's cells; the caller has looked at the lengths, as above.
py::tuple shapes(const HeldTable& table, const Numbers& area, const Numbers& deformation, const Numbers& ratio,
                 const MeasuringConditions& conditions) {
  const ShapeMap* const map = table.map->shapes();
  if (!map)
    throw UserError(fmt::format("The table {} does not know the shapes of its cells; take one of rheocyte's own.",
                                table.map->origin().identifier));
  std::vector<ShapeExcess> found(span_of(area).size());
  map->compare(conditions, {span_of(area), span_of(deformation), {}}, span_of(ratio), found);
  const auto column = [&](double ShapeExcess::*member) {
    std::vector<double> values(found.size());
    std::ranges::transform(found, values.begin(), member);
    return array_of(std::move(values));
  };
  return py::make_tuple(column(&ShapeExcess::expected), column(&ShapeExcess::excess), column(&ShapeExcess::error),
                        column(&ShapeExcess::odd_fraction));
}

// Moduli in the measurement, whose viscosity must be given.
py::list lines(const HeldTable& table, std::vector<double> levels_kPa, int count,
               const MeasuringConditions& conditions) {
  const double factor = scale_factors(table.map->origin().flow, conditions.flow).modulus;
  if (levels_kPa.empty())
    levels_kPa = even_levels(*table.map, count);
  else
    for (double& level : levels_kPa) level /= factor;
  py::list list;
  for (const auto& line : isoelasticity_lines(*table.map, levels_kPa).lines)
    list.append(py::make_tuple(line.modulus_kPa * factor, seen(*table.map, conditions, line.points)));
  return list;
}

// The table in dclab's format, and its isoelasticity lines.
void write_texts(const HeldTable& table, const std::string& rows, const std::string& lines) {
  const py::gil_scoped_release without_interpreter;
  write_texts_of_map(*table.map, to_path(rows), to_path(lines));
}

// Its first line states whether an older file is one of ours.
void write_dclab_plugin(const std::string& program, const std::string& file) {
  const py::gil_scoped_release without_interpreter;
  replace_own_file(to_path(file), program + data_of_dclab_plugin(), program.substr(0, program.find('\n')),
                   Foreign::keep);
}

py::dict origin(const HeldTable& table) {
  const TableOrigin& o = table.map->origin();
  py::dict d;
  d["identifier"] = o.identifier;
  d["model"] = o.model;
  d["program"] = o.program;
  d["spec"] = o.spec;
  d["channel_width_um"] = o.flow.width_um;
  d["flow_rate_ul_s"] = o.flow.rate_ul_s;
  d["viscosity_mPas"] = o.flow.viscosity_mPas;
  d["flow_exponent"] = o.flow.exponent;
  d["description"] = o.description();
  d["is_own"] = table.map->is_rheocyte_table();
  return d;
}

std::map<std::string, std::string> table_files() {
  std::map<std::string, std::string> files;
  for (const auto& [name, file] : shipped_tables()) files.emplace(name, file.string());
  return files;
}

HeldTable table_for(double flow_exponent) {
  const auto tables = std::make_shared<const ModulusTables>("");
  return {SharedMap(tables, &tables->used(flow_exponent))};
}

}  // namespace

const Binding bind_tables([](py::module_& module) {
  py::class_<MeasuringConditions>(module, "Conditions")
      .def(py::init(&measuring_conditions))
      .def("set_viscosity", [](MeasuringConditions& c, double mPas) { c.flow.viscosity_mPas = mPas; });
  py::class_<HeldTable>(module, "Table")
      .def(py::init([](const std::string& name) { return HeldTable{read_modulus_map(find_table(name))}; }))
      .def_static("for_exponent", &table_for)
      .def("origin", &origin)
      .def("modulus", &modulus)
      .def("shapes", &shapes)
      .def("lines", &lines)
      .def("write_texts", &write_texts)
      .def("support",
           [](const HeldTable& t, const MeasuringConditions& c) { return seen(*t.map, c, support(*t.map)); });
  module.def("table_files", &table_files);
  module.def("write_dclab_plugin", &write_dclab_plugin);
  module.attr("state_names") =
      std::vector<std::string_view>(names_of_modulus_states.begin(), names_of_modulus_states.end());
});

}  // namespace rheocyte

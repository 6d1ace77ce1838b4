#include "table/dynamic_spec.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "case/case_keys.h"
#include "case/key_reading.h"
#include "case/read_case.h"
#include "case/scales.h"
#include "case/write_keys.h"
#include "numeric/fingerprint.h"
#include "numeric/lagrange.h"

namespace rheocyte {

namespace {

constexpr std::array<std::string_view, 3> cell_keys{"cell.radius_um", "cell.bulk.young_modulus_kPa",
                                                    "cell.viscosity_mPas"};
constexpr std::array<std::string_view, 5> keys_of_way{"time.end_us", "time.end_um", "time.output_every_us",
                                                      "time.output_every_um", "numerics.accuracy"};

template <auto field>
Key<DynamicSpec> dynamic_key(KeyDescription description) {
  return key_of<DynamicSpec, field>(std::move(description));
}

using Dynamic = DynamicSpec;

const std::array all_dynamic_keys = {
    dynamic_key<&Dynamic::identifier>(
        {"dynamic.identifier", "", "name of the table: letters, digits and hyphens", Word{}}),
    dynamic_key<&Dynamic::min_radius_um>(
        {"dynamic.min_radius_um", "um", "radius of the smallest cells at rest", Number{{0.01, 5000}}}),
    dynamic_key<&Dynamic::max_radius_um>(
        {"dynamic.max_radius_um", "um", "radius of the largest cells at rest", Number{{0.01, 5000}}}),
    dynamic_key<&Dynamic::min_young_modulus_kPa>(
        {"dynamic.min_young_modulus_kPa", "kPa",
         "Young's modulus of the softest of the largest cells; that of smaller ones is "
         "lower, as radius^1.5",
         Number{{1e-6, 1e9}}}),
    dynamic_key<&Dynamic::max_young_modulus_kPa>({"dynamic.max_young_modulus_kPa", "kPa",
                                                  "Young's modulus of the stiffest of the largest cells",
                                                  Number{{1e-6, 1e9}}}),
    dynamic_key<&Dynamic::min_time_ms>({"dynamic.min_time_ms", "ms",
                                        "minimum 3 x viscosity / Young's modulus of the cells", Number{{1e-6, 1e6}},
                                        0.05}),
    dynamic_key<&Dynamic::max_time_ms>({"dynamic.max_time_ms", "ms",
                                        "maximum 3 x viscosity / Young's modulus of the cells", Number{{1e-6, 1e6}},
                                        10.0}),
    dynamic_key<&Dynamic::first_um>(
        {"dynamic.first_um", "um", "first place, measured from the end of the contraction", Number{{0, 1e6}}, 10.0}),
    dynamic_key<&Dynamic::last_um>(
        {"dynamic.last_um", "um", "last place, measured from the end of the contraction", Number{{0, 1e6}}, 310.0}),
    dynamic_key<&Dynamic::radii>(
        {"dynamic.radii", "", "number of radii that are computed", Number{{2, 30}, true}, 4.0}),
    dynamic_key<&Dynamic::moduli>(
        {"dynamic.moduli", "", "number of moduli that are computed for each radius", Number{{2, 30}, true}, 5.0}),
    dynamic_key<&Dynamic::times>({"dynamic.times", "",
                                  "number of times 3 x viscosity / Young's modulus that are computed for each of these",
                                  Number{{2, 30}, true}, 12.0}),
    dynamic_key<&Dynamic::places>(
        {"dynamic.places", "", "number of places at which each cell is stored", Number{{4, 1000}, true}, 31.0}),
    dynamic_key<&Dynamic::checks>(
        {"dynamic.checks", "",
         "number of additional cells between the others, to estimate the error of the interpolation",
         Number{{0, 1000}, true}, 8.0}),
};

void refuse_keys_of_table(const KeyReading& keys) {
  constexpr std::string_view section = "channel.section";
  if (keys.chosen(section) == "rectangle")
    keys.refuse_stated(section,
                       "is for single cells; dynamic tables are computed in tubes and in the square channel of a chip, "
                       "leave it out or choose \"square\"");
  const auto refuse = [&](std::string_view key) {
    if (keys.has(key))
      keys.refuse_stated(key, "must not be given, because a dynamic table chooses it; see the section [dynamic]");
  };
  std::ranges::for_each(cell_keys, refuse);
  std::ranges::for_each(keys_of_way, refuse);
}

void check_ranges(const DynamicSpec& spec, const KeyReading& keys) {
  const auto check = [&](double min, double max, std::string_view low, std::string_view high) {
    if (min < max) return;
    keys.refuse(keys.has(low) ? low : high,
                fmt::format("{} = {:g} is not below {} = {:g}; the table would be empty.", low, min, high, max));
  };
  check(spec.min_radius_um, spec.max_radius_um, "dynamic.min_radius_um", "dynamic.max_radius_um");
  check(spec.min_young_modulus_kPa, spec.max_young_modulus_kPa, "dynamic.min_young_modulus_kPa",
        "dynamic.max_young_modulus_kPa");
  check(spec.min_time_ms, spec.max_time_ms, "dynamic.min_time_ms", "dynamic.max_time_ms");
  check(spec.first_um, spec.last_um, "dynamic.first_um", "dynamic.last_um");
  const double R = unit_length_um(spec.base);
  for (const auto& [name, radius] :
       {std::pair("dynamic.min_radius_um", spec.min_radius_um), std::pair("dynamic.max_radius_um", spec.max_radius_um)})
    if (radius < min_radius_ratio * R || radius > max_radius_ratio * R)
      keys.refuse_stated(name,
                         fmt::format("is outside its range {:.4g} .. {:.4g} um, {} .. {} of the narrowest radius",
                                     min_radius_ratio * R, max_radius_ratio * R, min_radius_ratio, max_radius_ratio));
}

void check_cells(const Case& c, const KeyReading& keys) {
  if (c.channel.profile.x_um.empty())
    keys.refuse_stated("channel.profile.x_um",
                       "is missing; a dynamic table needs the contraction that its cells come through, with "
                       "channel.profile.R_um or channel.profile.width_um");
  if (c.cell.bulk.law == BulkLaw::none)
    keys.refuse_stated("cell.bulk.law",
                       "has no Young's modulus; a dynamic table is for cells with an elastic interior");
  if (!is_power_law(c.flow.law))
    keys.refuse_stated("flow.law", "does not scale between flow rates; choose \"newtonian\" or \"power-law\"");
}

void check_dynamic_identifier(const DynamicSpec& spec, const KeyReading& keys) {
  const auto is_plain = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-';
  };
  if (spec.identifier.empty() || spec.identifier.size() > 60 || !std::ranges::all_of(spec.identifier, is_plain))
    keys.refuse_stated("dynamic.identifier", "is not a name of a table; take 1 to 60 letters, digits and hyphens");
}

/// Digits of a number in a base behind the point, mirrored: evenly spread over (0, 1) (van der Corput).
double spread_number(int number, int base) {
  double value = 0, digit = 1;
  for (; number > 0; number /= base) value += (digit /= base) * (number % base);
  return value;
}

}  // namespace

std::span<const Key<DynamicSpec>> dynamic_keys() { return all_dynamic_keys; }

Reference dynamic_reference() {
  return {.title = "Dynamic table reference",
          .topic = "dynamic",
          .declaration = "src/table/dynamic_spec.cc",
          .opening = "The spec of a dynamic table is a text file in TOML. The shortest one:",
          .example = R"([channel.profile]
x_um = [60.0, 100.0]
R_um = [21.88, 10.94]
[flow]
rate_ul_per_s = 0.04
viscosity_mPas = 15.0
[dynamic]
identifier = "my-first-dynamic-table"
min_radius_um = 5.0
max_radius_um = 8.0
min_young_modulus_kPa = 3.0
max_young_modulus_kPa = 20.0
)",
          .rules =
              "It has all keys of a case in time (`rheocyte help case`) but the cell's radius, Young's modulus and\n"
              "viscosity, the end of the way and the outputs; and those of the section [dynamic]. `--set key=value`\n"
              "replaces a key of the file. `rheocyte table SPEC -o DIR` computes it.\n",
          .keys = key_list(dynamic_keys())};
}

bool is_dynamic_spec(std::string_view text, const std::string& name, std::span<const std::string> settings) {
  return std::ranges::any_of(given_keys(text, name, settings, specification("table")),
                             [](const GivenKey& given) { return given.key.starts_with("dynamic."); });
}

DynamicCoordinates coordinates_of(const DynamicSpec& spec, const DynamicCell& cell) {
  return {cell.radius_um,
          std::log(cell.young_modulus_kPa) - power_of_radius * std::log(cell.radius_um / spec.max_radius_um),
          std::log(cell.time_ms)};
}

DynamicCell cell_at(const DynamicSpec& spec, const DynamicCoordinates& at) {
  return {at[0], std::exp(at[1] + power_of_radius * std::log(at[0] / spec.max_radius_um)), std::exp(at[2])};
}

std::array<std::vector<double>, 3> nodes_of(const DynamicSpec& spec) {
  return {chebyshev_points(spec.min_radius_um, spec.max_radius_um, spec.radii),
          chebyshev_points(std::log(spec.min_young_modulus_kPa), std::log(spec.max_young_modulus_kPa), spec.moduli),
          chebyshev_points(std::log(spec.min_time_ms), std::log(spec.max_time_ms), spec.times)};
}

int nodes(const DynamicSpec& spec) { return spec.radii * spec.moduli * spec.times; }

std::vector<DynamicCell> cells_of(const DynamicSpec& spec) {
  const auto axes = nodes_of(spec);
  std::vector<DynamicCell> cells;
  for (const double radius : axes[0])
    for (const double modulus : axes[1])
      for (const double time : axes[2]) cells.push_back(cell_at(spec, {radius, modulus, time}));
  for (int i = 1; i <= spec.checks; ++i) {
    constexpr std::array bases{2, 3, 5};
    DynamicCoordinates at;
    for (std::size_t k = 0; k < 3; ++k) at[k] = std::lerp(axes[k].front(), axes[k].back(), spread_number(i, bases[k]));
    cells.push_back(cell_at(spec, at));
  }
  return cells;
}

double end_of_contraction_um(const Case& c) { return c.channel.profile.x_um.back(); }

std::vector<double> places_of(const DynamicSpec& spec) {
  std::vector<double> places;
  for (int i = 0; i < spec.places; ++i)
    places.push_back(std::lerp(spec.first_um, spec.last_um, double(i) / (spec.places - 1)));
  return places;
}

Case case_of(const DynamicSpec& spec, const DynamicCell& cell) {
  Case c = spec.base;
  c.cell.radius_um = cell.radius_um;
  c.cell.bulk.young_modulus_kPa = cell.young_modulus_kPa;
  c.cell.viscosity_mPas = cell.viscosity_mPas();
  c.time.end_us.reset();
  c.time.output_every_us.reset();
  c.time.end_um = end_of_contraction_um(c) + spec.last_um;
  c.time.output_every_um = (spec.last_um - spec.first_um) / (spec.places - 1);
  return c;
}

DynamicSpec parse_dynamic_spec(std::string_view text, const std::string& name, std::span<const std::string> settings) {
  const KeyList known = key_list(case_keys(), dynamic_keys());
  refuse_keys_of_table(KeyReading(known, given_keys(text, name, settings, specification("table")), name, "dynamic"));
  std::vector<std::string> all(settings.begin(), settings.end());
  all.insert(all.end(), {"time.end_um=1", "time.output_every_um=1"});  // so that the case is complete; see case_of
  KeyReading keys(known, given_keys(text, name, all, specification("table")), name, "dynamic");
  DynamicSpec spec;
  spec.base = complete_case(keys, {cell_keys.begin(), cell_keys.end()});
  keys.fill(spec, dynamic_keys());
  check_dynamic_identifier(spec, keys);
  check_cells(spec.base, keys);
  check_ranges(spec, keys);
  spec.base = case_of(spec, {spec.max_radius_um, spec.max_young_modulus_kPa, spec.min_time_ms});
  return spec;
}

std::string to_toml(const DynamicSpec& spec) {
  std::vector<std::string_view> left_out(cell_keys.begin(), cell_keys.end());
  left_out.insert(left_out.end(), keys_of_way.begin(), keys_of_way.end());
  left_out.insert(left_out.end(), {"flow.drive", "time.scheme"});
  const auto values = values_of(spec.base, case_keys(), spec, dynamic_keys());
  return to_toml(values, left_out);
}

std::string spec_hash(const DynamicSpec& spec) { return fingerprint(to_toml(spec)); }

}  // namespace rheocyte

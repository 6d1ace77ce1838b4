#include "case/case_line.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "case/case_keys.h"
#include "case/nearest_name.h"
#include "case/scales.h"
#include "case/user_error.h"

namespace rheocyte {
namespace {

/// Of a number: so little that third derivatives do not count, so much that rounding does not.
constexpr double relative_step = 2e-5;

constexpr std::string_view bending = "cell.cortex.bending_kBT";

/// What holds the cell's shape, in kPa.
double stiffness_kPa(const Case& c) {
  const double cortex = c.cell.cortex.modulus_mN_per_m.value_or(0) + tension_mN_per_m(c);
  return c.cell.bulk.young_modulus_kPa.value_or(0) + cortex / c.cell.radius_um;
}

/// What a number that is 0 is compared with, in its unit.
double scale_at_zero(const Case& c, const KeyDescription& key) {
  constexpr double Pa_per_kPa = 1e3, of_water = 1e3;
  if (key.unit == "Pa") return stiffness_kPa(c) * Pa_per_kPa;
  if (key.unit == "mN/m") return stiffness_kPa(c) * c.cell.radius_um;
  if (key.unit == "kg/m3") return of_water;
  if (key.unit == "mPa s") return c.flow.zero_shear_viscosity_mPas.value_or(1);
  return 1;
}

std::optional<double> number_of(const Case& c, const Key<Case>& key) {
  const auto value = key.get(c);
  return value && std::holds_alternative<double>(*value) ? std::optional(std::get<double>(*value)) : std::nullopt;
}

/// Whether the unit of lengths goes along a line with the number.
bool has_smooth_units(const Case& c, const Key<Case>& key, double value, double step) {
  const auto length = [&](double at) {
    Case moved = c;
    key.set(moved, at);
    return unit_length_um(moved);
  };
  constexpr double round_off = 1e-9;
  const double middle = unit_length_um(c);
  return std::abs(length(value + step) + length(value - step) - 2 * middle) < round_off * middle;
}

struct Place {
  double steps, weight;  ///< the latter per step
};
constexpr std::array<Place, 2> both_sides{{{-1, -0.5}, {1, 0.5}}};
constexpr std::array<Place, 3> one_side{{{0, -1.5}, {1, 2}, {2, -0.5}}};

}  // namespace

std::vector<CasePoint> case_line(const Case& c, std::string_view name) {
  const Key<Case>& key = case_key(name);
  const Range& range = std::get<Number>(key.kind).range;
  const double value = number_of(c, key).value();
  double step = relative_step * (value == 0 ? scale_at_zero(c, key) : std::abs(value));
  const bool fits_above = range.contains(value + 2 * step);
  const bool is_central =
      range.contains(value - step) && range.contains(value + step) && has_smooth_units(c, key, value, step);
  if (!is_central && !fits_above) step = -step;
  std::vector<CasePoint> points;
  for (const Place& place : is_central ? std::span<const Place>(both_sides) : one_side) {
    CasePoint point{place.steps * step, place.weight / step, c};
    key.set(point.input, value + point.change);
    points.push_back(std::move(point));
  }
  return points;
}

std::vector<std::string_view> line_keys(const Case& c) {
  std::vector<std::string_view> names;
  for (const auto& key : case_keys()) {
    const auto* const number = std::get_if<Number>(&key.kind);
    const bool is_of_cell_in_flow =
        key.name.starts_with("channel.") || key.name.starts_with("flow.") || key.name.starts_with("cell.");
    if (!number || number->is_whole || !is_of_cell_in_flow || key.name == "channel.camera_degree") continue;
    const auto value = number_of(c, key);
    if (value && !(key.name == bending && *value == 0)) names.push_back(key.name);
  }
  return names;
}

std::vector<std::string_view> asked_line_keys(const Case& c, std::span<const std::string> keys,
                                              const std::string& name) {
  if (keys.empty()) return {};
  if (c.time.scheme != TimeScheme::stationary)
    throw UserError(fmt::format("{}: gradients exist for stationary cases; leave out the section time.", name));
  if (c.cell.place == CellPlace::equilibrium)
    throw UserError(
        fmt::format("{}: gradients exist for a cell at a given place; give the place that was found as cell.offset_um, "
                    "and cell.place = \"given\".",
                    name));
  std::vector<std::string_view> known = line_keys(c);
  if (std::ranges::find(keys, "all") != keys.end()) return known;
  std::vector<std::string_view> asked;
  for (const std::string& key : keys) {
    const auto found = std::ranges::find(known, key);
    if (found == known.end() && key == bending)
      throw UserError(fmt::format("{}: there is no gradient by {} where it is 0; its effect begins there.", name, key));
    if (found == known.end()) {
      const std::string near = did_you_mean(key, known);
      throw UserError(fmt::format("{}: there is no gradient by \"{}\"{} Of this case there are those by {}.", name,
                                  one_line(key, 60), near.empty() ? "." : near, fmt::join(known, ", ")));
    }
    if (std::ranges::find(asked, *found) == asked.end()) asked.push_back(*found);
  }
  return asked;
}

}  // namespace rheocyte

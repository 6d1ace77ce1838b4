#include "case/check_duct.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "case/scales.h"
#include "case/unit.h"

namespace rheocyte {

namespace {

// So much of the energy that deforms the cell: factors of single precision do not correct stiffer surfaces.
double max_bending_in_ducts_kBT(const Case& c) {
  constexpr double fraction = 4e-3;
  const double r0 = 1e-6 * c.cell.radius_um, mu = 1e3 * c.cell.bulk.young_modulus_kPa.value_or(0) / 3,
               shell = 1e-3 * c.cell.cortex.modulus_mN_per_m.value_or(0);
  return fraction * (mu * r0 + shell) * r0 * r0 / thermal_energy_J;
}

void check_duct_profile(const Case& c, const KeyReading& keys) {
  constexpr std::string_view radii = "channel.profile.R_um", rounding = "channel.profile.rounding_um",
                             section = "channel.section";
  if (keys.has(radii))
    keys.refuse_stated(
        radii, fmt::format("is for tubes, and {} is a duct; give channel.profile.width_um", keys.stated(section)));
  const bool has_profile = keys.has("channel.profile.x_um") || keys.has("channel.profile.width_um");
  if (!c.channel.width_um && !has_profile) keys.refuse_stated(section, "needs channel.width_um, not a radius");
  if (!keys.has(rounding)) return;
  if (!has_profile) keys.refuse_stated(rounding, "is for the walls of [channel.profile]; leave it out");
}

/// The material turns through the shape (docs/theory-time.md, eq:turning-in-time).
void check_off_axis_in_time(const Case& c, const KeyReading& keys) {
  if (is_centred(c.cell)) return;
  if (c.cell.place == CellPlace::equilibrium)
    keys.refuse_stated("cell.place",
                       "is for stationary shapes; leave it out, and [time] shows how the cell drifts there");
  if (c.numerics.accuracy_of.value_or(AccuracyOf::deformation) != AccuracyOf::deformation)
    keys.refuse_stated("numerics.accuracy_of", "is for stationary shapes; leave it out");
}

void check_duct_in_time(const Case& c, const KeyReading& keys) {
  if (c.time.scheme == TimeScheme::stationary) return;
  if (c.time.scheme == TimeScheme::partitioned)
    keys.refuse_stated("time.scheme", "is for tubes; choose \"monolithic\", or leave channel.section out");
  if (c.flow.drive != Drive::rate)
    keys.refuse_stated(keys.has("flow.drive") ? "flow.drive" : "flow.pressure_drop_Pa",
                       "is for tubes, or for stationary shapes, where the channel is a duct; give flow.rate_ul_per_s");
  check_off_axis_in_time(c, keys);
  constexpr double greatest_degree = 6;
  if (c.time.degree.value_or(0) > greatest_degree)
    keys.refuse_stated("time.degree",
                       fmt::format("needs too much memory in ducts; at most {:g} are possible", greatest_degree));
}

constexpr double most_unequal_sides = 4;

}  // namespace

void check_rectangle(const Case& c, const KeyReading& keys) {
  constexpr std::string_view height_key = "channel.height_um", camera = "channel.camera",
                             rounding = "channel.profile.rounding_um";
  if (!is_duct(c.channel.section)) return;
  if (const double least = least_rounding * unit_length_um(c); c.channel.profile.rounding_um.value_or(least) < least)
    keys.refuse_stated(rounding, fmt::format("is less than the mesh resolves; at least {:.4g} um are needed", least));
  if (c.channel.section != Section::rectangle) return;
  const double width = least_width_um(c.channel), height = *c.channel.height_um;
  if (std::max(width, height) > most_unequal_sides * std::min(width, height))
    keys.refuse_stated(
        height_key, fmt::format("is outside its range {:.4g} .. {:.4g} um, a quarter to four times {}",
                                width / most_unequal_sides, width * most_unequal_sides,
                                c.channel.width_um ? "channel.width_um" : "the minimum of channel.profile.width_um"));
  if (c.channel.camera == View::diagonal)
    keys.refuse_stated(camera, "is for squares; give the angle channel.camera_degree");
}

void check_duct(const Case& c, const KeyReading& keys) {
  if (!is_duct(c.channel.section)) return;
  check_duct_profile(c, keys);
  check_duct_in_time(c, keys);
  const double most = max_bending_in_ducts_kBT(c);
  if (c.cell.cortex.bending_kBT > most)
    keys.refuse_stated("cell.cortex.bending_kBT",
                       fmt::format("exceeds the maximum that can be solved in ducts, {:.2g} kBT for this cell, and is "
                                   "far above that of cells; lower it, or use the tube",
                                   most));
}

}  // namespace rheocyte

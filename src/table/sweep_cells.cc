// The cells of a table's branches as cases.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "case/case_keys.h"
#include "case/scales.h"
#include "case/unit.h"
#include "laws/uniaxial.h"
#include "numeric/lagrange.h"
#include "table/table_spec.h"

namespace rheocyte {

namespace {

// Deformed cells of a table have up to a tenth more area than the sphere.
constexpr double min_fraction_of_sphere = 0.9;

// The singularity of radius_coordinate, in h.
constexpr double beyond_wall = 1.05;

// A fraction of 0 or 1 leaves nothing of the other one: not even a modulus of zero.
void set_moduli(Case& c, const SweepPoint& place, double stiffness) {
  const double bulk = (1 - place.cortex_fraction) * stiffness,
               cortex = place.cortex_fraction * stiffness * place.radius_um;
  c.cell.bulk.young_modulus_kPa.reset();
  c.cell.cortex.modulus_mN_per_m.reset();
  c.cell.cortex.tension_ratio.reset();
  c.cell.cortex.tension_mN_per_m.reset();
  if (bulk > 0)
    c.cell.bulk.young_modulus_kPa = bulk;
  else
    c.cell.bulk.law = BulkLaw::none;
  if (cortex > 0) {
    c.cell.cortex.modulus_mN_per_m = cortex;
    c.cell.cortex.tension_ratio = place.tension_ratio;
  } else {
    c.cell.cortex.law = CortexLaw::none;
    c.cell.cortex.tension_mN_per_m = 0;
  }
}

double bending_kBT(const TableSpec& spec, const SweepPoint& place, double stiffness) {
  const double radius = place.radius_um * 1e-6;
  const double modulus = 1e3 * (spec.sweeps_cortex() ? stiffness / place.radius_um : stiffness);
  return spec.bending_ratio * modulus * radius * radius * radius / thermal_energy_J;
}

std::pair<double, double> first_and_last_radius_um(const TableSpec& spec) {
  const double R = unit_length_um(spec.base);
  return {std::max(std::sqrt(min_fraction_of_sphere * spec.min_area_um2 / std::numbers::pi), min_radius_ratio * R),
          std::min(std::sqrt(spec.max_area_um2 / std::numbers::pi), max_radius_ratio * R)};
}

}  // namespace

std::vector<double> sweep_radii_um(const TableSpec& spec) {
  const auto [first, last] = first_and_last_radius_um(spec);
  std::vector<double> radii;
  for (int i = 0; i < spec.radii; ++i) radii.push_back(first + (last - first) * i / (spec.radii - 1));
  radii.back() = last;
  return radii;
}

std::vector<double> computed_radii_um(const TableSpec& spec) {
  const auto [first_um, last_um] = first_and_last_radius_um(spec);
  const double h = unit_length_um(spec.base);
  std::vector<double> radii;
  for (const double at :
       chebyshev_points(radius_coordinate(first_um / h), radius_coordinate(last_um / h), spec.computed_radii.value()))
    radii.push_back(h * radius_ratio_at(at));
  radii.front() = first_um;
  radii.back() = last_um;
  return radii;
}

double radius_coordinate(double radius_ratio) { return -std::log(beyond_wall - radius_ratio); }

double radius_ratio_at(double radius_coordinate) { return beyond_wall - std::exp(-radius_coordinate); }

std::vector<SweepPoint> sweep_places(const TableSpec& spec) {
  std::vector<SweepPoint> places;
  const auto radii = spec.is_square() ? computed_radii_um(spec) : sweep_radii_um(spec);
  const auto add = [&](double fraction, double ratio, double axial) {
    for (const double radius : radii) places.push_back({radius, fraction, ratio, axial});
  };
  for (const double axial : spec.is_elongated() ? spec.axial_ratios : std::vector{0.0}) {
    if (!spec.is_combined()) add(0, 0, axial);
    for (const double ratio : spec.tension_ratios)
      for (const double fraction : spec.cortex_fractions)
        if (fraction > 0 || ratio == spec.tension_ratios.front()) add(fraction, ratio, axial);
  }
  return places;
}

Case case_at(const TableSpec& spec, const SweepPoint& place, double stiffness) {
  Case c = spec.base;
  c.cell.radius_um = place.radius_um;
  if (spec.is_combined())
    set_moduli(c, place, stiffness);
  else
    case_key(spec.stiffness_key).set(c, stiffness);
  if (spec.elongation == Elongation::by_rest_shape)
    c.cell.rest_aspect = aspect_by_tension(place.axial_ratio);
  else
    c.flow.axial_tension_Pa = 1e3 * place.axial_ratio * stiffness;
  if (spec.bending_ratio > 0) c.cell.cortex.bending_kBT = bending_kBT(spec, place, stiffness);
  c.numerics.accuracy = spec.accuracy;
  return c;
}

TableSpec regularised_spec(TableSpec spec) {
  if (spec.bending_beyond_kBT > 0) spec.base.cell.cortex.bending_kBT = spec.bending_beyond_kBT;
  if (spec.bending_beyond_ratio > 0) spec.bending_ratio = spec.bending_beyond_ratio;
  return spec;
}

double regularising_bending_kBT(const TableSpec& spec, double radius_um, double stiffness) {
  return case_at(regularised_spec(spec), {radius_um}, stiffness).cell.cortex.bending_kBT;
}

}  // namespace rheocyte

// What is measured on a state of cell and liquid: the one list from which result.json, the tables' columns,
// history.csv, the check of all numbers and the reference of results are made.
#pragma once
#include <algorithm>
#include <array>
#include <functional>
#include <numbers>
#include <string_view>
#include <variant>

#include "case/unit.h"
#include "numeric/no_value.h"
#include "shape/measures.h"
#include "shape/outline_tilt.h"

namespace rheocyte {

/// The numbers of a state; dimensionless, in the units of case/problem.h.
struct StateNumbers {
  ShapeMeasures shape;  ///< of the contour; lengths in R
  double deformation_side = no_value, deformation_across = no_value, deformation_diagonal = no_value;
  double volume_of_revolution = no_value;  ///< of the contour; in a tube that of the cell
  double relative_volume_change = no_value;
  double cell_velocity = no_value;             ///< in U
  double drift_velocity = no_value;            ///< of a cell off the axis, along its offset, in U
  double spin = no_value;                      ///< rate at which its material turns, in U/R
  double offset = no_value;                    ///< of its barycentre, in R
  double offset_error = no_value;              ///< of the place of equilibrium; as above
  OutlineTilt tilt;                            ///< of its outline in the plane of the offset
  double flow_rate = no_value;                 ///< mean velocity in U
  double volume_flow = no_value;               ///< in R^2 U
  double pressure_drop = no_value;             ///< over the simulated channel, in S
  double additional_pressure_drop = no_value;  ///< the part that is due to the cell
  double inner_pressure = no_value;            ///< in S, the undisturbed pressure at the cell being 0
  double channel_length = no_value;            ///< simulated, in R
  double tube_radius = 1;                      ///< in R
  double shear_rate_max = no_value;            ///< of the liquid beside the cell, in U/R
  double reynolds = no_value;                  ///< rho v_cell U / S
  double min_meridional_stretch = no_value;    ///< over the surface
  double biot_ratio =
      no_value;  ///< least meridional over normal stretch; Mooney-Rivlin solids wrinkle below 0.2956 (eq:biot)
  double stability_margin = no_value;  ///< of the surface: 0 = limit (solve/surface_stability.h)
  double min_tension = no_value;       ///< meridional, over the surface, in S R; a shell wrinkles where it is negative
};

/// The files beside result.json in which a measure is a column.
enum class AlsoIn { none, tables, history, both };

/// How a number settles on ever finer resolutions: with the outline as a whole, with the pressure in the liquid, with
/// the surface or the liquid at single points, which are right later, or by itself alone, being given or conserved.
enum class SettlesWith { outline, pressure, points, itself };

/// A mode of the outline's radius.
struct ShapeMode {
  RadiusModes ShapeMeasures::*modes;
  int k;
};

/// A number of result.json.
struct StateMeasure {
  std::string_view name;  ///< ends with its unit
  std::string_view sentence;
  std::variant<double StateNumbers::*, double ShapeMeasures::*, ShapeMode, double OutlineTilt::*> member;
  AlsoIn columns = AlsoIn::none;     ///< a column of tables must be smooth along a branch
  std::string_view null_where = {};  ///< where there is no such number; elsewhere it is finite
  SettlesWith settles_with = SettlesWith::outline;

  constexpr bool in_tables() const { return columns == AlsoIn::tables || columns == AlsoIn::both; }
  constexpr bool in_history() const { return columns == AlsoIn::history || columns == AlsoIn::both; }
  /// Of the outline from a circle, or of the surface from its limit; it may be next to nothing.
  constexpr bool is_departure() const {
    return std::holds_alternative<ShapeMode>(member) || std::holds_alternative<double OutlineTilt::*>(member) ||
           name.starts_with("deformation") || name == "stability_margin";
  }
  /// Where the number stands, to be read or to be set.
  template <class Numbers>
  constexpr auto& of(Numbers& numbers) const {
    if (const auto* of_shape = std::get_if<double ShapeMeasures::*>(&member)) return numbers.shape.**of_shape;
    if (const auto* mode = std::get_if<ShapeMode>(&member))
      return (numbers.shape.*mode->modes)[std::size_t(mode->k - first_radius_mode)];
    if (const auto* of_tilt = std::get_if<double OutlineTilt::*>(&member)) return numbers.tilt.**of_tilt;
    return numbers.*std::get<double StateNumbers::*>(member);
  }
  constexpr double value(const StateNumbers& numbers) const { return of(numbers); }
  constexpr double physical(const StateNumbers& numbers, const Scales& scales) const {
    return value(numbers) * dimensionless_one(unit_of(name), scales);
  }
};

/// In the order in which they are written and documented.
inline constexpr StateMeasure state_measures[] = {
    {"deformation", "1 - 2 sqrt(pi A) / P of the contour's convex hull, which is what a camera sees",
     &ShapeMeasures::deformation, AlsoIn::both},
    {"deformation_raw", "the same of the contour itself", &ShapeMeasures::deformation_raw, AlsoIn::both},
    {"deformation_side", "the same of the silhouette seen at right angles to a wall, in a rectangle along its height",
     &StateNumbers::deformation_side, AlsoIn::history, "in a tube, or for a cell off the axis"},
    {"deformation_across", "the same of the silhouette seen along the width of the channel",
     &StateNumbers::deformation_across, AlsoIn::history, "in a tube, or for a cell off the axis"},
    {"deformation_diagonal", "the same of the silhouette seen along the diagonal of the channel",
     &StateNumbers::deformation_diagonal, AlsoIn::none,
     "in a tube, a rectangle or a funnel, or for a cell off the axis"},
    {"area_um2", "area of the contour's convex hull", &ShapeMeasures::area, AlsoIn::both},
    {"area_raw_um2", "area within the contour", &ShapeMeasures::area_raw, AlsoIn::tables},
    {"perimeter_um", "perimeter of the convex hull", &ShapeMeasures::perimeter, AlsoIn::tables},
    {"perimeter_raw_um", "perimeter of the contour", &ShapeMeasures::perimeter_raw},
    {.name = "volume_um3",
     .sentence = "volume of the cell, in a tube the body of revolution of the contour",
     .member = &ShapeMeasures::volume,
     .columns = AlsoIn::both,
     .settles_with = SettlesWith::itself},
    {"volume_of_revolution_um3", "volume of the body of revolution of the contour, which programs compute from images",
     &StateNumbers::volume_of_revolution},
    {.name = "relative_volume_change",
     .sentence = "change of the volume since the sphere at rest; the cell is incompressible",
     .member = &StateNumbers::relative_volume_change,
     .columns = AlsoIn::history,
     .settles_with = SettlesWith::itself},
    {"moment_ratio",
     "ratio of the second moments of area of the convex hull, across the flow over along it; below 1: elongated along "
     "the flow",
     &ShapeMeasures::moment_ratio, AlsoIn::tables},
    {"moment_ratio_raw", "the same of the contour", &ShapeMeasures::moment_ratio_raw, AlsoIn::tables},
    {"inertia_ratio", "1 / sqrt(moment_ratio), as RT-DC programs have it", &ShapeMeasures::inertia_ratio, AlsoIn::both},
    {"mode_2",
     "cosine mode c_2 of the radius of the convex hull about its centroid, over the mean radius: r = 1 + sum c_k "
     "cos(k theta), theta = 0 along the flow",
     ShapeMode{&ShapeMeasures::modes, 2}, AlsoIn::both},
    {"mode_3", "its cosine mode c_3", ShapeMode{&ShapeMeasures::modes, 3}, AlsoIn::both},
    {"mode_4", "its cosine mode c_4", ShapeMode{&ShapeMeasures::modes, 4}, AlsoIn::both},
    {"mode_5", "its cosine mode c_5", ShapeMode{&ShapeMeasures::modes, 5}, AlsoIn::both},
    {"mode_6", "its cosine mode c_6", ShapeMode{&ShapeMeasures::modes, 6}, AlsoIn::both},
    {"mode_7", "its cosine mode c_7", ShapeMode{&ShapeMeasures::modes, 7}, AlsoIn::both},
    {"mode_2_raw", "c_2 of the contour itself about its centroid", ShapeMode{&ShapeMeasures::modes_raw, 2},
     AlsoIn::tables},
    {"mode_3_raw", "c_3 of the contour itself about its centroid", ShapeMode{&ShapeMeasures::modes_raw, 3},
     AlsoIn::tables},
    {"mode_4_raw", "c_4 of the contour itself about its centroid", ShapeMode{&ShapeMeasures::modes_raw, 4},
     AlsoIn::tables},
    {"mode_5_raw", "c_5 of the contour itself about its centroid", ShapeMode{&ShapeMeasures::modes_raw, 5},
     AlsoIn::tables},
    {"mode_6_raw", "c_6 of the contour itself about its centroid", ShapeMode{&ShapeMeasures::modes_raw, 6},
     AlsoIn::tables},
    {"mode_7_raw", "c_7 of the contour itself about its centroid", ShapeMode{&ShapeMeasures::modes_raw, 7},
     AlsoIn::tables},
    {"cell_velocity_m_per_s", "velocity of the cell along the channel", &StateNumbers::cell_velocity, AlsoIn::both},
    {"drift_velocity_m_per_s",
     "velocity of a cell off the axis along its offset; negative: towards the axis where the "
     "offset is positive",
     &StateNumbers::drift_velocity, AlsoIn::history, "for a cell on the axis"},
    {"rotation_rate_per_s", "angular velocity at which the material of a cell off the axis turns through its shape",
     &StateNumbers::spin, AlsoIn::history, "for a cell on the axis"},
    {"offset_um", "place of its barycentre off the axis", &StateNumbers::offset, AlsoIn::history,
     "for a cell on the axis"},
    {.name = "offset_error_um",
     .sentence = "error of the place where it does not drift (cell.place = \"equilibrium\")",
     .member = &StateNumbers::offset_error,
     .null_where = "for a given place, and on the axis",
     .settles_with = SettlesWith::itself},
    {"sine_mode_2",
     "sine mode s_2 of the radius of its outline in the plane of the offset about its centroid, over the mean radius: "
     "r = "
     "1 + sum c_k cos(k theta) + s_k sin(k theta), theta = 0 along the flow, 90 degrees along the offset",
     &OutlineTilt::sine_mode_2, AlsoIn::history, "for a cell on the axis"},
    {"sine_mode_3", "its sine mode s_3", &OutlineTilt::sine_mode_3, AlsoIn::none, "for a cell on the axis"},
    {"sine_mode_4", "its sine mode s_4", &OutlineTilt::sine_mode_4, AlsoIn::none, "for a cell on the axis"},
    {"flank_slope",
     "slope dy/dx, y along the offset, of the line midway between both flanks of this outline, from 20 to 75 % of its "
     "length "
     "behind the nose; negative beside the axis (y > 0) where the nose points to it",
     &OutlineTilt::flank_slope, AlsoIn::history, "for a cell on the axis"},
    {.name = "mean_velocity_m_per_s",
     .sentence = "flow rate over the area of the channel",
     .member = &StateNumbers::flow_rate,
     .settles_with = SettlesWith::itself},
    {.name = "flow_rate_ul_per_s",
     .sentence = "flow rate through the channel; the given one unless the pressure drop is given",
     .member = &StateNumbers::volume_flow,
     .columns = AlsoIn::history,
     .settles_with = SettlesWith::itself},
    {.name = "pressure_drop_Pa",
     .sentence = "pressure drop over the simulated length of the channel",
     .member = &StateNumbers::pressure_drop,
     .columns = AlsoIn::history,
     .settles_with = SettlesWith::pressure},
    {.name = "additional_pressure_drop_Pa",
     .sentence = "the part of it that is due to the cell",
     .member = &StateNumbers::additional_pressure_drop,
     .columns = AlsoIn::tables,
     .null_where = "in a channel that is not straight",
     .settles_with = SettlesWith::pressure},
    {.name = "inner_pressure_Pa",
     .sentence = "pressure in a pure shell, that of the undisturbed flow at the cell being 0",
     .member = &StateNumbers::inner_pressure,
     .null_where = "where the interior is elastic",
     .settles_with = SettlesWith::pressure},
    {.name = "simulated_length_um",
     .sentence = "length of the simulated channel, over which pressure_drop_Pa is",
     .member = &StateNumbers::channel_length,
     .settles_with = SettlesWith::itself},
    {.name = "tube_radius_um",
     .sentence = "radius of the tube that stands for the channel, the minimum if it varies",
     .member = &StateNumbers::tube_radius,
     .null_where = "where the channel is computed in three dimensions",
     .settles_with = SettlesWith::itself},
    {"reynolds",
     "density x cell velocity x tube radius / viscosity, which is the liquid's at the shear rate mean velocity / tube "
     "radius; in a duct with half the smaller width as the radius",
     &StateNumbers::reynolds},
    {.name = "shear_rate_max_per_s",
     .sentence = "maximum shear rate sqrt(2 D:D) of the liquid next to the cell, between the planes across the channel "
                 "through its poles, cell and wall included",
     .member = &StateNumbers::shear_rate_max,
     .settles_with = SettlesWith::points},
    {.name = "least_meridional_stretch",
     .sentence = "minimum stretch of the surface along the meridian, in a square channel in any direction",
     .member = &StateNumbers::min_meridional_stretch,
     .columns = AlsoIn::tables,
     .settles_with = SettlesWith::points},
    {.name = "biot_ratio",
     .sentence = "minimum ratio of meridional (in a square channel the minimum) to normal stretch of the surface; a "
                 "bare surface wrinkles below 0.2956, that of a fung solid later",
     .member = &StateNumbers::biot_ratio,
     .settles_with = SettlesWith::points},
    {.name = "stability_margin",
     .sentence = "distance of the surface from losing its stability, to short wrinkles (which bending stiffness or "
                 "tension keep "
                 "off) or by a cortex without resistance to compression: 1 for the sphere, 0 at the limit",
     .member = &StateNumbers::stability_margin,
     .columns = AlsoIn::both,
     .settles_with = SettlesWith::points},
    {.name = "least_tension_mN_per_m",
     .sentence = "minimum meridional tension of the surface; a shell wrinkles where it is negative",
     .member = &StateNumbers::min_tension,
     .columns = AlsoIn::history,
     .settles_with = SettlesWith::points}};

/// Those that are columns of a file, in their order.
template <bool (StateMeasure::*is_column)() const>
constexpr auto measures_in() {
  std::array<StateMeasure, std::ranges::count(state_measures, true, is_column)> chosen{};
  std::ranges::copy_if(state_measures, chosen.begin(), std::identity(), is_column);
  return chosen;
}
inline constexpr auto table_measures = measures_in<&StateMeasure::in_tables>();
inline constexpr auto history_measures = measures_in<&StateMeasure::in_history>();

}  // namespace rheocyte

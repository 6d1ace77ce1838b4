#include "case/read_case.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "case/case_keys.h"
#include "case/case_text.h"
#include "case/check_duct.h"
#include "case/check_profile.h"
#include "case/key_reading.h"
#include "case/problem.h"
#include "case/scales.h"

namespace rheocyte {

namespace {

// One mirror plane is left to a cell off the axis; seen along its offset its outline is symmetric.
void check_offset(const Case& c, const KeyReading& keys, bool has_radius) {
  const std::vector<double>& offset = c.cell.offset_um;
  if (c.cell.place == CellPlace::equilibrium && is_centred(c.cell))
    keys.refuse_stated("cell.place",
                       "is for cells off the axis; give cell.offset_um, from where the search starts, or leave it out");
  if (offset.empty()) return;
  const auto refuse = [&](std::string_view reason) { keys.refuse_stated("cell.offset_um", reason); };
  if (offset.size() != 2) refuse("must be two numbers, along the width and along the height");
  if (offset[0] != 0 && offset[1] != 0)
    refuse("is off the axis in both directions, where no symmetry is left; one of the two numbers must be 0");
  if (is_centred(c.cell)) return;
  if (!has_radius) refuse("is for single cells; leave it out of tables");
  if (camera_of(c.channel).degrees != (offset[0] != 0 ? 90 : 0))
    refuse(offset[0] != 0 ? "is along the width, along which the camera must look: give channel.camera_degree = 90"
                          : "is along the height, along which the camera must look: leave channel.camera and "
                            "channel.camera_degree out");
  if (c.flow.drive != Drive::rate) refuse("is for a given flow rate; give flow.rate_ul_per_s");
  if (c.cell.bulk.law == BulkLaw::none)
    refuse("is for cells with an elastic interior; the turning surface of a shell would drag its liquid round");
  const Extent extent = extent_of(c);
  const bool is_along_profile = offset[0] != 0 && has_profile(keys);
  const double half = is_along_profile ? WallProfile(wall_radii_um(c)).radius(0)
                                       : unit_length_um(c) * (offset[0] != 0 ? extent.width : extent.height);
  const double most = max_offset(half, c.cell.radius_um);
  if (std::abs(offset[0] + offset[1]) > most)
    refuse(fmt::format("is too close to the wall for cell.radius_um = {:g}; at most {:.4g} um are possible",
                       c.cell.radius_um, most));
}

void check_cell_in_tube(const Case& c, const KeyReading& keys) {
  const double R = unit_length_um(c), r0 = c.cell.radius_um;
  const bool is_by_wall = has_profile(keys) && std::ranges::min(wall_radii_um(c).radius) == R;
  if (is_by_wall && r0 > max_radius_ratio * R)
    keys.refuse(wall_key(c, keys),
                fmt::format("{} falls to {:g} um, which is narrower than the cell of cell.radius_um = "
                            "{:g} can pass; at least {:.4g} um are needed.",
                            radii_text(c, keys), R, r0, r0 / max_radius_ratio));
  if (r0 >= min_radius_ratio * R && r0 <= max_radius_ratio * R) return;
  constexpr std::string_view key = "cell.radius_um";
  const auto what = c.channel.section == Section::square      ? "half width of the square"
                    : c.channel.section == Section::rectangle ? "smaller half width of the rectangle"
                                                              : "tube radius";
  keys.refuse_stated(
      key, fmt::format("is outside its range {:.4g} .. {:.4g} um, {} .. {} of the {} {:.6g} um", min_radius_ratio * R,
                       max_radius_ratio * R, min_radius_ratio, max_radius_ratio, what, R));
}

// The ends of the channel must not see the cell.
void check_length(const Case& c, const KeyReading& keys) {
  if (!c.channel.length_um) return;
  const double R = unit_length_um(c), ratio = c.cell.radius_um / R;
  const double half = is_duct(c.channel.section) ? min_half_length(ratio, extent_of(c)) : min_half_length(ratio);
  const double least = 2 * R * half;
  if (*c.channel.length_um >= least) return;
  constexpr std::string_view key = "channel.length_um";
  keys.refuse_stated(key, fmt::format("is too short for the flow round the cell; it must be at least {:.4g} um, give "
                                      "the pressure drop over such a length",
                                      std::ceil(least)));
}

// A liquid interior at rest holds no shear stress: the surface must, or the liquid drags it round without end.
void check_cell_is_elastic(const Case& c, const KeyReading& keys) {
  if (c.cell.bulk.law != BulkLaw::none || c.cell.cortex.law != CortexLaw::none) return;
  constexpr std::string_view key = "cell.bulk.law";
  const bool drop = c.cell.cortex.tension_mN_per_m.value_or(0) > 0 || c.cell.cortex.bending_kBT > 0;
  keys.refuse_stated(key,
                     fmt::format("and cell.cortex.law = \"none\" leave {}; choose a law for the bulk or the cortex",
                                 drop ? "a drop, which circulates inside and has no stationary shape of this kind"
                                      : "a cell without any elasticity or tension"));
}

// Frames are kept in memory and drawn one by one.
constexpr double max_outputs = 10000;

// Such grids are for the low degrees of the paper; the cell has about a tenth of the square of these elements.
constexpr int most_surface_elements = 400;
constexpr double max_grid_degree = 3;

void check_grid(const Case& c, const KeyReading& keys) {
  if (c.time.grid_um.value_or(0) == 0) return;
  constexpr std::string_view key = "time.grid_um";
  if (surface_elements(c) > most_surface_elements)
    keys.refuse_stated(key,
                       fmt::format("makes {} elements along the surface; at most {} are possible, a size of {:.3g} um",
                                   surface_elements(c), most_surface_elements,
                                   std::numbers::pi * c.cell.radius_um / most_surface_elements));
  const double degree = c.time.degree.value_or(max_grid_degree + 1);
  if (degree > max_grid_degree)
    keys.refuse_stated(
        key, fmt::format("is for low degrees; choose time.degree = 2 as in the paper, at most {:g}", max_grid_degree));
}

/// By which the sphere is stretched along x when it has its shape without stress, or starts in time.
double first_stretch(const Case& c) { return c.time.start_stretch.value_or(1) * std::pow(c.cell.rest_aspect, 2.0 / 3); }

void check_elongation(const Case& c, const KeyReading& keys, bool has_radius) {
  constexpr std::string_view aspect = "cell.rest_aspect", tension = "flow.axial_tension_Pa",
                             tension_profile = "channel.profile.axial_tension_Pa";
  const ChannelProfile& profile = c.channel.profile;
  if (!profile.axial_tension_Pa.empty()) {
    if (c.flow.axial_tension_Pa != 0)
      keys.refuse_stated(tension, fmt::format("and {} exclude each other; give one of them", tension_profile));
    if (profile.axial_tension_Pa.size() != profile.x_um.size())
      keys.refuse(tension_profile,
                  fmt::format("{} has {} numbers and {} has {}; give one tension for each place.", tension_profile,
                              profile.axial_tension_Pa.size(), profile_x, profile.x_um.size()));
    if (!has_radius) keys.refuse_stated(tension_profile, "is for single cells; leave it out of tables");
  }
  if (!has_radius && c.flow.axial_tension_Pa != 0)
    keys.refuse_stated(tension, "is for single cells; leave it out of tables");
  if (c.cell.rest_aspect == 1) return;
  if (!has_radius) keys.refuse_stated(aspect, "is for single cells; leave it out of tables");
  if (!is_centred(c.cell))
    keys.refuse_stated(aspect,
                       "has no stationary shape off the axis, where the rest shape turns with the material; leave it "
                       "out, or give flow.axial_tension_Pa");
  if (c.cell.viscoelasticity == Viscoelasticity::maxwell)
    keys.refuse_stated(aspect, "is for cells with a shape at rest, which a Maxwell liquid does not have; leave it out");
}

void check_start(const Case& c, const KeyReading& keys) {
  const double stretch = first_stretch(c);
  const WallTable wall = wall_um(c.channel.profile);
  const bool is_as_narrow = wall.is_straight() || is_duct(c.channel.section);
  const double R = is_as_narrow ? unit_length_um(c) : WallProfile(wall).radius(0);
  const double widest = c.cell.radius_um / std::sqrt(stretch);
  if (widest <= max_radius_ratio * R || stretch >= 1) return;
  const double least = std::pow(c.cell.radius_um / (max_radius_ratio * R), 2);
  const bool is_start = c.time.start_stretch.value_or(1) < 1;
  const std::string_view key = is_start ? "time.start_stretch" : "cell.rest_aspect";
  keys.refuse_stated(
      key, fmt::format("widens the cell to a radius of {:.4g} um in a channel of {:.4g} um; take at least {:.3g}",
                       widest, R, is_start ? least * *c.time.start_stretch / stretch : std::pow(least, 1.5)));
}

void check_viscoelasticity(const Case& c, const KeyReading& keys) {
  constexpr std::string_view key = "cell.viscoelasticity";
  const auto kind = c.cell.viscoelasticity.value_or(Viscoelasticity::kelvin_voigt);
  if (kind == Viscoelasticity::kelvin_voigt) return;
  if (c.cell.bulk.law == BulkLaw::none)
    keys.refuse_stated(key, "is for an elastic interior, and cell.bulk.law is \"none\"; leave it out");
  if (kind == Viscoelasticity::maxwell && c.cell.bulk.law != BulkLaw::neo_hookean)
    keys.refuse_stated(key, "has a neo-Hookean spring; choose cell.bulk.law = \"neo-hookean\"");
}

void check_outputs(const Case& c, const KeyReading& keys) {
  const bool ends_at_place = c.time.end_um.has_value(), by_place = c.time.output_every_um.has_value();
  // An undisturbed liquid needs that long for the way, or goes as far in that time: right within a factor of a few.
  const double speed_um_per_us = scales_of(c).velocity_m_per_s;
  double end = ends_at_place ? *c.time.end_um : *c.time.end_us;
  if (ends_at_place && !by_place) end /= speed_um_per_us;
  if (!ends_at_place && by_place) end *= speed_um_per_us;
  const double every = by_place ? *c.time.output_every_um : *c.time.output_every_us, outputs = end / every;
  if (outputs <= max_outputs) return;
  const auto* key = ends_at_place ? "time.end_um" : "time.end_us";
  keys.refuse_stated(key,
                     fmt::format("and time.output_every_{} = {:g} ask for {:.3g} outputs; at most {:g} are possible",
                                 by_place ? "um" : "us", every, outputs, max_outputs));
}

void check_time(const Case& c, const KeyReading& keys) {
  if (c.flow.drive == Drive::controlled_pressure && c.time.scheme != TimeScheme::partitioned)
    keys.refuse_stated("flow.drive",
                       "adapts the pressure step by step, which is for time.scheme = \"partitioned\" only; remove it, "
                       "a given flow rate is met exactly");
  if (c.time.scheme == TimeScheme::stationary) return;
  check_grid(c, keys);
  check_outputs(c, keys);
  check_viscoelasticity(c, keys);
}

}  // namespace

Case complete_case(KeyReading& keys, std::vector<std::string_view> left_open) {
  const bool has_radius = std::ranges::find(left_open, "cell.radius_um") == left_open.end();
  if (has_profile(keys)) left_open.insert(left_open.end(), {"channel.width_um", "channel.radius_um"});
  keys.complete(left_open);
  Case c;
  keys.fill(c, case_keys());
  check_duct(c, keys);
  check_profile(c, keys);
  check_rectangle(c, keys);
  if (has_radius) {
    check_cell_in_tube(c, keys);
    check_length(c, keys);
    check_start(c, keys);
  }
  check_elongation(c, keys, has_radius);
  check_offset(c, keys, has_radius);
  check_cell_is_elastic(c, keys);
  check_time(c, keys);
  return c;
}

Case parse_case(std::string_view text, const std::string& name, std::span<const std::string> settings) {
  KeyReading keys(key_list(case_keys()), given_keys(text, name, settings), name, "case");
  return complete_case(keys);
}

Case read_case(const std::filesystem::path& file, std::span<const std::string> settings) {
  return parse_case(read_case_text(file), file.string(), settings);
}

}  // namespace rheocyte

#include "case/read_case.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "case/case_keys.h"
#include "case/case_text.h"
#include "case/key_reading.h"
#include "case/scales.h"

namespace rheocyte {

namespace {

constexpr std::string_view profile_x = "channel.profile.x_um", profile_R = "channel.profile.R_um";

bool has_profile(const KeyReading& keys) { return keys.has(profile_x) || keys.has(profile_R); }

// The mesh follows the wall along straight spokes and has elements as wide as the tube.
constexpr double steepest_wall = 0.5, greatest_widening = 5;
constexpr std::size_t most_places = 1000;

void check_wall(const ChannelProfile& wall, const KeyReading& keys) {
  const std::size_t n = wall.x_um.size();
  if (wall.R_um.size() != n)
    keys.refuse(profile_R, fmt::format("{} has {} numbers and {} has {}; give one radius for each place.", profile_R,
                                       wall.R_um.size(), profile_x, n));
  if (n < 2 || n > most_places)
    keys.refuse(profile_x, fmt::format("{} has {} places; a profile needs 2 .. {}, before and behind the contraction.",
                                       profile_x, n, most_places));
  for (std::size_t i = 1; i < n; ++i) {
    const double length = wall.x_um[i] - wall.x_um[i - 1], change = std::abs(wall.R_um[i] - wall.R_um[i - 1]);
    if (!(length > 0))
      keys.refuse(profile_x,
                  fmt::format("{} does not increase from {} to {}; give the places in the order of the flow.",
                              profile_x, wall.x_um[i - 1], wall.x_um[i]));
    if (change > steepest_wall * length)
      keys.refuse(
          profile_R,
          fmt::format("{} changes by {:.4g} um between x = {} and {} um, which is too short and too steep for the "
                      "mesh; give this change a length of {:.4g} um.",
                      profile_R, change, wall.x_um[i - 1], wall.x_um[i], change / steepest_wall));
  }
}

void check_profile(const Case& c, const KeyReading& keys) {
  if (!has_profile(keys)) return;
  for (const auto& [one, other] : {std::pair{profile_x, profile_R}, std::pair{profile_R, profile_x}})
    if (!keys.has(one))
      keys.refuse(other, fmt::format("{} is given without {}; give both, or channel.radius_um for a straight channel.",
                                     other, one));
  for (const auto* straight : {"channel.width_um", "channel.radius_um"})
    if (keys.has(straight))
      keys.refuse(straight, fmt::format("{} and the section [channel.profile] exclude each other; give exactly one of "
                                        "them.",
                                        keys.stated(straight)));
  check_wall(c.channel.profile, keys);
  const double least = tube_radius_um(c), widest = *std::ranges::max_element(c.channel.profile.R_um);
  if (widest > greatest_widening * least)
    keys.refuse(profile_R, fmt::format("{} goes from {:g} to {:g} um; the widest part may be {:g} times as wide as the "
                                       "narrowest one.",
                                       profile_R, least, widest, greatest_widening));
  if (c.flow.drive == Drive::rate) return;
  const std::string_view drive = keys.has("flow.drive") ? "flow.drive" : "flow.pressure_drop_Pa";
  keys.refuse(drive, fmt::format("{} is for straight channels; give flow.rate_ul_per_s with [channel.profile].",
                                 keys.stated(drive)));
}

constexpr double most_unequal_sides = 4;

void check_rectangle(const Case& c, const KeyReading& keys) {
  if (c.channel.section != Section::rectangle) return;
  const double width = *c.channel.width_um, height = *c.channel.height_um;
  if (std::max(width, height) > most_unequal_sides * std::min(width, height))
    keys.refuse("channel.height_um",
                fmt::format("{} is outside its range {:.4g} .. {:.4g} um, a quarter to four times channel.width_um.",
                            keys.stated("channel.height_um"), width / most_unequal_sides, width * most_unequal_sides));
  if (c.channel.camera == View::diagonal)
    keys.refuse("channel.camera",
                fmt::format("{} is for squares; give the angle channel.camera_degree.", keys.stated("channel.camera")));
}

// What is computed in tubes alone.
void check_duct(const Case& c, const KeyReading& keys) {
  if (!is_duct(c.channel.section)) return;
  const auto refuse = [&](std::string_view key, std::string_view reason) {
    keys.refuse(key, fmt::format("{} {}.", keys.stated(key), reason));
  };
  if (!c.channel.width_um || has_profile(keys))
    refuse("channel.section", "needs channel.width_um, not a radius or a profile");
  if (c.time.scheme != TimeScheme::stationary)
    refuse("channel.section", "is for stationary shapes; leave [time] out, or take the tube");
  if (c.cell.bulk.law == BulkLaw::none || c.cell.cortex.law != CortexLaw::none ||
      c.cell.cortex.tension_mN_per_m.value_or(0) > 0 || c.cell.cortex.bending_kBT > 0)
    refuse("channel.section",
           "is for an elastic interior without a cortex, tension or bending stiffness; leave them out, or take the "
           "tube");
}

void check_cell_in_tube(const Case& c, const KeyReading& keys) {
  const double R = unit_length_um(c), r0 = c.cell.radius_um;
  if (has_profile(keys) && r0 > greatest_radius_ratio * R)
    keys.refuse(
        profile_R,
        fmt::format("{} falls to {:g} um, which is narrower than the cell of cell.radius_um = {:g} can pass; at least "
                    "{:.4g} um are needed.",
                    profile_R, R, r0, r0 / greatest_radius_ratio));
  if (r0 >= least_radius_ratio * R && r0 <= greatest_radius_ratio * R) return;
  constexpr std::string_view key = "cell.radius_um";
  const auto what = c.channel.section == Section::square      ? "half width of the square"
                    : c.channel.section == Section::rectangle ? "lesser half width of the rectangle"
                                                              : "tube radius";
  keys.refuse(key, fmt::format("{} is outside its range {:.4g} .. {:.4g} um, {} .. {} of the {} {:.6g} um.",
                               keys.stated(key), least_radius_ratio * R, greatest_radius_ratio * R, least_radius_ratio,
                               greatest_radius_ratio, what, R));
}

// The ends of the channel must not see the cell.
void check_length(const Case& c, const KeyReading& keys) {
  if (!c.channel.length_um) return;
  const double R = unit_length_um(c), ratio = c.cell.radius_um / R;
  const double half = is_duct(c.channel.section) ? least_half_length(ratio, extent_of(c)) : least_half_length(ratio);
  const double least = 2 * R * half;
  if (*c.channel.length_um >= least) return;
  constexpr std::string_view key = "channel.length_um";
  keys.refuse(key, fmt::format("{} is too short for the flow round the cell; it must be at least {:.4g} um, give the "
                               "pressure drop over such a length.",
                               keys.stated(key), std::ceil(least)));
}

// A liquid interior at rest holds no shear stress: the surface must, or the liquid drags it round without end.
void check_cell_is_elastic(const Case& c, const KeyReading& keys) {
  if (c.cell.bulk.law != BulkLaw::none || c.cell.cortex.law != CortexLaw::none) return;
  constexpr std::string_view key = "cell.bulk.law";
  const bool drop = c.cell.cortex.tension_mN_per_m.value_or(0) > 0 || c.cell.cortex.bending_kBT > 0;
  keys.refuse(key, fmt::format("{} and cell.cortex.law = \"none\" leave {}; choose a law for the bulk or the cortex.",
                               keys.stated(key),
                               drop ? "a drop, which circulates inside and has no stationary shape of this kind"
                                    : "a cell without any elasticity or tension"));
}

// Frames are kept in memory and drawn one by one.
constexpr double greatest_outputs = 10000;

// Such grids are for the low degrees of the paper; the cell has about a tenth of the square of these elements.
constexpr int most_surface_elements = 400;
constexpr double greatest_grid_degree = 3;

void check_grid(const Case& c, const KeyReading& keys) {
  if (c.time.grid_um.value_or(0) == 0) return;
  constexpr std::string_view key = "time.grid_um";
  if (surface_elements(c) > most_surface_elements)
    keys.refuse(key,
                fmt::format("{} makes {} elements along the surface; at most {} are possible, a size of {:.3g} um.",
                            keys.stated(key), surface_elements(c), most_surface_elements,
                            std::numbers::pi * c.cell.radius_um / most_surface_elements));
  if (*c.time.degree > greatest_grid_degree)
    keys.refuse(key,
                fmt::format("{} is for low degrees, and time.degree is {:g}; choose time.degree = 2 as in the paper.",
                            keys.stated(key), *c.time.degree));
}

void check_time(const Case& c, const KeyReading& keys) {
  if (c.flow.drive == Drive::controlled_pressure && c.time.scheme != TimeScheme::partitioned)
    keys.refuse(
        "flow.drive",
        fmt::format("{} adapts the pressure step by step, which is for time.scheme = \"partitioned\" only; remove it, "
                    "a given flow rate is met exactly.",
                    keys.stated("flow.drive")));
  if (c.time.scheme == TimeScheme::stationary) return;
  check_grid(c, keys);
  const double end = *c.time.end_us, outputs = end / *c.time.output_every_us;
  if (outputs > greatest_outputs)
    keys.refuse("time.end_us",
                fmt::format("{} and time.output_every_us = {:g} ask for {:.3g} outputs; at most {:g} are possible.",
                            keys.stated("time.end_us"), *c.time.output_every_us, outputs, greatest_outputs));
}

}  // namespace

Case complete_case(KeyReading& keys, std::vector<std::string_view> left_open) {
  const bool has_radius = std::ranges::find(left_open, "cell.radius_um") == left_open.end();
  if (has_profile(keys)) left_open.insert(left_open.end(), {"channel.width_um", "channel.radius_um"});
  keys.complete(left_open);
  Case c;
  keys.fill(c, case_keys());
  check_duct(c, keys);
  check_rectangle(c, keys);
  check_profile(c, keys);
  if (has_radius) {
    check_cell_in_tube(c, keys);
    check_length(c, keys);
  }
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

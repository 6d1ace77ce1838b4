#include "case/check_profile.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "case/scales.h"

namespace rheocyte {

namespace {

constexpr std::string_view profile_R = "channel.profile.R_um", profile_width = "channel.profile.width_um";

/// Past steeper ones no mesh follows large cells (docs/theory-time.md, eq:wall). The side walls of a chip are far from
/// a cell on the axis, and their corners are round (sec. 5).
double steepest_wall(const Case& c) { return is_duct(c.channel.section) && is_centred(c.cell) ? 10 : 1; }

/// Admits lengths as they are advised, with four digits.
constexpr double rounding_of_advice = 1e-3;
constexpr double max_widening = 5;
constexpr std::size_t most_places = 1000;

void check_places(const Case& c, const KeyReading& keys) {
  const ChannelProfile& wall = c.channel.profile;
  const std::size_t n = wall.x_um.size(), given = wall.width_um.empty() ? wall.R_um.size() : wall.width_um.size();
  const std::string_view key = wall_key(c, keys);
  if (given != n)
    keys.refuse(key, fmt::format("{} has {} numbers and {} has {}; give one {} for each place.", key, given, profile_x,
                                 n, key == profile_R ? "radius" : "width"));
  if (n < 2 || n > most_places)
    keys.refuse(profile_x,
                fmt::format("{} has {} places; a profile needs 2 .. {}, upstream and downstream of the contraction.",
                            profile_x, n, most_places));
  for (std::size_t i = 1; i < n; ++i)
    if (!(wall.x_um[i] > wall.x_um[i - 1]))
      keys.refuse(profile_x,
                  fmt::format("{} does not increase from {} to {}; give the places in the order of the flow.",
                              profile_x, wall.x_um[i - 1], wall.x_um[i]));
}

void check_slopes(const Case& c, const KeyReading& keys) {
  const WallTable wall = wall_radii_um(c);
  const double steepest = steepest_wall(c);
  for (std::size_t i = 1; i < wall.x.size(); ++i) {
    const double length = wall.x[i] - wall.x[i - 1], change = std::abs(wall.radius[i] - wall.radius[i - 1]);
    if (change <= (1 + rounding_of_advice) * steepest * length) continue;
    keys.refuse(
        wall_key(c, keys),
        fmt::format("{} changes by {:.4g} um between x = {:.4g} and {:.4g} um: no mesh follows large cells past "
                    "walls steeper than {:g} : 1; give this change a length of at least {:.4g} um.",
                    radii_text(c, keys), change, wall.x[i - 1], wall.x[i], steepest, change / steepest));
  }
}

}  // namespace

bool has_profile(const KeyReading& keys) {
  return keys.has(profile_x) || keys.has(profile_R) || keys.has(profile_width);
}

std::string radii_text(const Case& c, const KeyReading& keys) {
  if (is_duct(c.channel.section)) return "half of channel.profile.width_um";
  return keys.has(profile_width) ? "the radius of the tube for channel.profile.width_um" : std::string(profile_R);
}

std::string_view wall_key(const Case& c, const KeyReading& keys) {
  return keys.has(profile_width) || is_duct(c.channel.section) ? profile_width : profile_R;
}

WallTable wall_radii_um(const Case& c) {
  if (!is_duct(c.channel.section)) return wall_um(c.channel.profile);
  WallTable wall{c.channel.profile.x_um, c.channel.profile.width_um};
  for (double& radius : wall.radius) radius /= 2;
  return wall;
}

void check_profile(const Case& c, const KeyReading& keys) {
  if (!has_profile(keys)) return;
  const std::string_view wall = wall_key(c, keys);
  for (const auto& [one, other] : {std::pair{profile_x, wall}, std::pair{wall, profile_x}})
    if (!keys.has(one))
      keys.refuse(other, fmt::format("{} is given without {}; give both, or {} for a straight channel.", other, one,
                                     is_duct(c.channel.section) ? "channel.width_um" : "channel.radius_um"));
  for (const auto* straight : {"channel.width_um", "channel.radius_um"})
    if (keys.has(straight))
      keys.refuse_stated(straight, "and the section [channel.profile] exclude each other; give exactly one of them");
  check_places(c, keys);
  check_slopes(c, keys);
  const WallTable walls = wall_radii_um(c);
  const auto [narrow, wide] = std::ranges::minmax_element(walls.radius);
  const double least = *narrow, widest = *wide;
  if (widest > max_widening * least)
    keys.refuse(wall, fmt::format("{} goes from {:g} to {:g} um; the widest part may be {:g} times as "
                                  "wide as the narrowest one.",
                                  radii_text(c, keys), least, widest, max_widening));
  if (c.flow.drive == Drive::rate) return;
  const std::string_view drive = keys.has("flow.drive") ? "flow.drive" : "flow.pressure_drop_Pa";
  keys.refuse_stated(drive, "is for straight channels; give flow.rate_ul_per_s with [channel.profile]");
}

}  // namespace rheocyte

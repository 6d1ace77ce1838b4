// The wall of a channel that is not straight, as its keys state it.
#pragma once
#include <string>
#include <string_view>

#include "case/case.h"
#include "case/key_reading.h"
#include "laws/wall_profile.h"

namespace rheocyte {

inline constexpr std::string_view profile_x = "channel.profile.x_um";

bool has_profile(const KeyReading&);

/// The key of the wall, and words for its radii: as given, or as they follow from widths.
std::string_view wall_key(const Case&, const KeyReading&);
std::string radii_text(const Case&, const KeyReading&);

/// Radii of the tube, or half widths of the duct.
WallTable wall_radii_um(const Case&);

/// UserErrors for profiles that are incomplete, out of order or too steep, or go from too wide to too narrow.
void check_profile(const Case&, const KeyReading&);

}  // namespace rheocyte

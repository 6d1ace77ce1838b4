#include <fmt/format.h>

#include "case/case_keys.h"
#include "case/key_reference.h"
#include "case/scales.h"

namespace rheocyte {

Reference case_reference() {
  return {
      .title = "Case reference",
      .topic = "case",
      .declaration = "src/case/case_keys.cc",
      .opening = "A case of rheocyte is a text file in TOML. The shortest one:",
      .example = R"([channel]
width_um = 20.0
[flow]
rate_ul_per_s = 0.04
viscosity_mPas = 15.0
[cell]
radius_um = 7.66
[cell.bulk]
young_modulus_kPa = 3.437
)",
      .rules = fmt::format(
          "Give exactly one of channel.width_um, channel.radius_um and the section [channel.profile]. A width stands\n"
          "for a tube of radius {} x width, which has the same pressure drop. The cell's radius must be {} .. {}\n"
          "of the tube's. Whole numbers may stand for real ones. A key that has no effect for the chosen law is an\n"
          "error. `--set key=value` replaces a key of the file; keys of the file that lose their effect through it\n"
          "are dropped.\n",
          tube_radius_per_channel_width, min_radius_ratio, max_radius_ratio),
      .keys = key_list(case_keys())};
}

}  // namespace rheocyte

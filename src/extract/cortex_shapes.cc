#include "extract/cortex_shapes.h"

#include <algorithm>
#include <cmath>

namespace rheocyte {

bool are_of_cortex(const OutlinesBesideSolids& o) {
  // Beyond those of solids c_4 of cells with a cortex is lower and c_5 higher, together by 0.18 to 0.25 of c_3 (virtual
  // cells of 1 to 2 kPa with 10 to 20 mN/m, d = 0.01 to 0.015); of solids of any law by -0.07 to 0.02 of it. Another
  // rule for the pixels of the edge than "centre inside" makes up to 0.05 pixels of the radius, whatever c_3 is
  // (bench/independent_recordings.py: up to 0.0041 where the radius has 14 pixels).
  constexpr double of_asymmetry = 0.06, of_masks_px = 0.06, usual_radius_px = 20, deviations = 4;
  const double of_masks = of_masks_px / (o.radius_px > 0 ? o.radius_px : usual_radius_px);
  const double difference = o.mode_5.value - o.mode_4.value, error = std::hypot(o.mode_4.error, o.mode_5.error);
  return difference > std::max(of_masks + of_asymmetry * std::abs(o.asymmetry), deviations * error);
}

}  // namespace rheocyte

// Where the free surface of a solid at a point loses stability to short wrinkles (docs/theory.md, sec. "surface
// instability").
#pragma once
#include "laws/bulk.h"

namespace rheocyte {

/// Biot's limit of Mooney-Rivlin solids: the real root of x^3 + x^2 + 3 x = 1.
inline constexpr double biot_limit = 0.29559774252208477;

/// Ratio of the stretch across the crests of wrinkles to the normal stretch at which they appear; `along` is the
/// stretch along the crests. The root of x^3 + x^2 + 3 x - 1 + c (1 - x^2)^2 with c = 2 b / along (eq:biot-fung). 0 for
/// c >= 1: no compression is too much.
inline double wrinkling_limit(const Bulk& bulk, double along) {
  const double c = bulk.law == BulkLaw::fung ? 2 * bulk.stiffening / along : 0;
  if (c == 0) return biot_limit;
  if (c >= 1) return 0;
  double x = biot_limit;
  // The slope is above 1 for c < 1: Newton's method doubles the digits in every step.
  for (int step = 0; step < 8; ++step) {
    const double squeezed = 1 - x * x;
    x -= (((x + 1) * x + 3) * x - 1 + c * squeezed * squeezed) / ((3 * x + 2) * x + 3 - 4 * c * x * squeezed);
  }
  return x;
}

/// Distance from that limit: 1 without deformation, 0 at the limit. `across` and `along` are the stretches of the
/// surface in these directions; the solid is incompressible, so that the normal stretch is 1 / (across along).
inline double wrinkling_margin(const Bulk& bulk, double across, double along) {
  const double limit = wrinkling_limit(bulk, along);
  return (across * across * along - limit) / (1 - limit);
}

}  // namespace rheocyte

#include "analytic/isoelasticity.h"

#include <cmath>

namespace rheocyte {
namespace {

IsoelasticityPoint point(const CellInTube& cell, double strain) {
  const ShapeMeasures shape = small_deformation(cell, strain).shape;
  return {cell.sphere.lambda, shape.area, shape.deformation};
}

// The point of a line between two of its points where the deformation has the wanted value. ln d is nearly a straight
// line of r0, so the false position converges in a few steps; Illinois' halving keeps an end from standing still.
IsoelasticityPoint point_at(double deformation, double strain, IsoelasticityPoint below, IsoelasticityPoint above) {
  const auto excess = [&](const IsoelasticityPoint& p) { return std::log(p.deformation / deformation); };
  double excess_below = excess(below), excess_above = excess(above);
  bool last_was_below = false, first = true;
  IsoelasticityPoint middle = below;
  for (int step = 0; step < 60 && std::abs(excess(middle)) > 1e-12; ++step, first = false) {
    const double share = excess_below / (excess_below - excess_above);
    middle = point(solid_in_tube(below.radius + share * (above.radius - below.radius)), strain);
    const bool is_below = excess(middle) < 0, again = !first && is_below == last_was_below;
    (is_below ? below : above) = middle;
    (is_below ? excess_below : excess_above) = excess(middle);
    if (again) (is_below ? excess_above : excess_below) /= 2;
    last_was_below = is_below;
  }
  return middle;
}

}  // namespace

std::vector<IsoelasticityLine> isoelasticity_lines(const IsoelasticityGrid& grid) {
  std::vector<CellInTube> cells;  // the flow is the same on all lines
  for (const double radius : grid.radii) cells.push_back(solid_in_tube(radius));
  std::vector<IsoelasticityLine> lines;
  for (const double capillary_number : grid.capillary_numbers) {
    const double strain = solid_strain(capillary_number, grid.duct);
    IsoelasticityLine& line = lines.emplace_back();
    for (const CellInTube& cell : cells) {
      const IsoelasticityPoint next = point(cell, strain);
      if (next.deformation <= grid.greatest_deformation) {
        line.push_back(next);
        continue;
      }
      // NaN, a shape without an inside, cannot be bracketed.
      if (!line.empty() && std::isfinite(next.deformation))
        line.push_back(point_at(grid.greatest_deformation, strain, line.back(), next));
      break;
    }
  }
  return lines;
}

}  // namespace rheocyte

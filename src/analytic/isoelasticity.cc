#include "analytic/isoelasticity.h"

#include <cmath>

#include "numeric/roots.h"

namespace rheocyte {
namespace {

IsoelasticityPoint point(const CellInTube& cell, double strain) {
  const ShapeMeasures shape = small_deformation(cell, strain).shape;
  return {cell.sphere.lambda, shape.area, shape.deformation};
}

// The point of a line between two of its points where the deformation has the requested value; ln d is nearly a
// straight line of r0.
IsoelasticityPoint point_at(double deformation, double strain, const IsoelasticityPoint& below,
                            const IsoelasticityPoint& above) {
  const auto at = [&](double radius) { return point(solid_in_tube(radius), strain); };
  const auto excess = [&](double radius) { return std::log(at(radius).deformation / deformation); };
  return at(bracketed_root(excess, below.radius, above.radius, 1e-13));
}

}  // namespace

std::vector<std::vector<IsoelasticityPoint>> isoelasticity_lines(const IsoelasticityGrid& grid) {
  std::vector<CellInTube> cells;  // the flow is the same on all lines
  for (const double radius : grid.radii) cells.push_back(solid_in_tube(radius));
  std::vector<std::vector<IsoelasticityPoint>> lines;
  for (const double capillary_number : grid.capillary_numbers) {
    const double strain = solid_strain(capillary_number, grid.duct);
    auto& line = lines.emplace_back();
    for (const CellInTube& cell : cells) {
      const IsoelasticityPoint next = point(cell, strain);
      if (next.deformation <= grid.max_deformation) {
        line.push_back(next);
        continue;
      }
      // NaN, a shape without an inside, cannot be bracketed.
      if (!line.empty() && std::isfinite(next.deformation))
        line.push_back(point_at(grid.max_deformation, strain, line.back(), next));
      break;
    }
  }
  return lines;
}

}  // namespace rheocyte

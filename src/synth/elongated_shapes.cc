#include "synth/elongated_shapes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "laws/uniaxial.h"
#include "synth/branch_shapes.h"
#include "synth/outline.h"
#include "synth/seen_outline.h"

namespace rheocyte {

std::variant<CellShape, NoShape> ElongatedCellShapes::at(double radius_um, double modulus_kPa,
                                                         double axial_ratio) const {
  const ElongatedCell least = table_.least(), greatest = table_.greatest();
  ElongatedCell place{table_.coordinate_of(radius_um), axial_ratio, 1};
  if (!(place(0) >= least(0))) return NoShape::too_small;
  if (!(place(0) <= greatest(0))) return NoShape::too_large;
  if (!(axial_ratio >= least(1) && axial_ratio <= greatest(1)))
    return is_long_at_rest() ? NoShape::outside_aspects : NoShape::outside_tensions;
  place(2) = std::exp(table_.at(place).log_modulus) / modulus_kPa;  // the compliance over that at the branch's end
  if (!(place(2) >= ElongatedTable::min_height)) return NoShape::too_stiff;
  if (!(place(2) <= greatest(2))) return NoShape::too_soft;
  const ElongatedState state = table_.at(place);
  CellShape shape;
  shape.area_um2 = std::exp(state.log_area());
  shape.deformation = state.value(number_of(ElongatedMeasure::deformation));
  shape.volume_um3 = 4 * std::numbers::pi / 3 * std::pow(radius_um, 3);
  RadiusModes modes;
  for (std::size_t k = 0; k < modes.size(); ++k)
    modes[k] = state.value(number_of(ElongatedMeasure::mode_2) + Eigen::Index(k));
  shape.meridian = outline_seen_with(modes, shape.deformation, shape.area_um2).topRows(outline_points / 2 + 1);
  return shape;
}

std::variant<CellShape, NoShape> ElongatedCellShapes::shape(const VirtualCell& cell) const {
  const ScaleFactors scale =
      scale_factors(table_.origin().flow, {flow_.width_um, flow_.rate_ul_s, cell.viscosity_mPas});
  if (!(cell.stiffness > 0)) return NoShape::too_soft;
  if (!(cell.radius_um > 0)) return NoShape::too_small;
  const double axial_ratio =
      is_long_at_rest() ? tension_by_aspect(cell.rest_aspect) : 1e-3 * cell.axial_tension_Pa / cell.stiffness;
  return scaled(at(cell.radius_um / scale.length, cell.stiffness / scale.modulus, axial_ratio), scale);
}

std::string ElongatedCellShapes::description() const {
  const double least = table_.least()(1), greatest = table_.greatest()(1);
  if (is_long_at_rest())
    return fmt::format("table {}, length over width of {:.3g} to {:.3g} at rest", table_.origin().description(),
                       aspect_by_tension(least), aspect_by_tension(greatest));
  return fmt::format("table {}, axial tensions of {:g} to {:g} E", table_.origin().description(), least, greatest);
}

}  // namespace rheocyte

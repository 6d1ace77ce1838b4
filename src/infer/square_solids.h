// Stationary solids in the square channel as a table of it knows them, seen from the channel of another table.
#pragma once
#include "infer/modulus_map.h"
#include "shape/outline_shape.h"

namespace rheocyte {

/// By how much less or more than a solid other cells are changed by the square channel: this fraction of each change is
/// counted as its error (docs/theory-extract.md, sec. "The square channel").
inline constexpr double left_by_section = 1.0 / 3;

/// Areas (um^2) and moduli (kPa) are those of the given channel and flow. Beyond what the table has the nearest counts.
class SquareSolids {
 public:
  /// A table of solids in the square channel that knows their shapes (asserted); it must outlive this.
  SquareSolids(const ModulusMap& square, const ChannelFlow& flow);

  /// Deformation of the cell with this area and |c_3|, or this Young's modulus.
  double deformation_by_mode_3(double area_um2, double mode_3) const;
  double deformation_by_modulus(double area_um2, double modulus_kPa) const;

  double modulus_kPa(double area_um2, double deformation) const;
  /// Of a cell that moves towards +x; modes beyond last_radius_mode are zero.
  ShapeVector shape(double area_um2, double deformation) const;

 private:
  double held_area(double area_um2) const;
  /// The deformation at which a quantity that grows along the branch reaches a value.
  template <class Quantity>
  double deformation_where(double area_um2, double value, const Quantity& quantity) const;

  const ModulusMap& square_;
  ScaleFactors to_square_;
};

}  // namespace rheocyte

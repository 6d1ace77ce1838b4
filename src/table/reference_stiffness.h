// The stiffness that a tube's table gives to cells of a square channel.
#pragma once
#include <optional>

#include "table/stiffness_grid.h"
#include "table/table_spec.h"

namespace rheocyte {

/// ln(E) as a function of r0 and ln(d) that takes most of its changes away: the tube's table at the area of the sphere,
/// continued in straight lines beyond its rims, or -ln(d) / 2. At the cell's own area, which grows with d, large cells
/// would cross the rim on their way.
class ReferenceStiffness {
 public:
  /// UserError if the tube's table is not one of solids in the liquid of the spec.
  ReferenceStiffness(const TableSpec& spec, const GridContent* tube);

  struct Value {
    double log_stiffness, by_log_deformation;
  };
  Value operator()(double radius_um, double log_deformation) const;

 private:
  std::optional<StiffnessGrid> grid_;
  double log_area_factor_ = 0, log_modulus_factor_ = 0;
};

}  // namespace rheocyte

// Virtual cells by the closed model of small deformations.
#pragma once
#include "analytic/small_deformation.h"
#include "synth/cell_shapes.h"

namespace rheocyte {

struct AnalyticConditionsOfCells {
  double channel_width_um = 0, flow_rate_ul_s = 0;
  bool is_shell = false;
  double tension_ratio = 0;  ///< gamma / E2D of a shell
  Duct duct = Duct::tube;
  double greatest_deformation = greatest_solid_deformation;
};

/// Solids and shells up to a given deformation and to r0 / R = greatest_ratio_of_agreement. Up to
/// greatest_solid_deformation (shells: greatest_shell_deformation) the deformation is within 10 % of the laws `linear`;
/// beyond, the shapes are those of the linear model all the same.
class AnalyticShapes : public CellShapes {
 public:
  explicit AnalyticShapes(const AnalyticConditionsOfCells& conditions) : conditions_(conditions) {}
  std::variant<CellShape, NoShape> shape(const VirtualCell& cell) const override;
  std::string description() const override;

 private:
  AnalyticConditionsOfCells conditions_;
};

}  // namespace rheocyte

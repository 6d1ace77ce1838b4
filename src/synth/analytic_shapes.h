// Virtual cells by the analytical model of small deformations.
#pragma once
#include "analytic/small_deformation.h"
#include "case/channel_flow.h"
#include "synth/cell_shapes.h"

namespace rheocyte {

/// Which cells flow where.
struct AnalyticPopulation {
  ChannelFlow flow;  ///< but for the viscosity, which the cells bring
  bool is_shell = false;
  double tension_ratio = 0;  ///< gamma / E2D of a shell
  Duct duct = Duct::tube;
  double max_deformation = max_solid_deformation;
};

/// Solids and shells up to a given deformation and to r0 / R = max_ratio_of_agreement. Up to
/// max_solid_deformation (shells: max_shell_deformation) the deformation is within 10 % of the laws `linear`;
/// beyond, the shapes are those of the linear model all the same.
class AnalyticShapes : public CellShapes {
 public:
  explicit AnalyticShapes(const AnalyticPopulation& population) : population_(population) {}
  std::variant<CellShape, NoShape> shape(const VirtualCell& cell) const override;
  std::string description() const override;

 private:
  AnalyticPopulation population_;
};

}  // namespace rheocyte

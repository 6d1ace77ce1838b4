// Virtual cells by sampled branches of simulated states: interpolation between radii and stiffnesses.
#pragma once
#include <vector>

#include "synth/cell_shapes.h"
#include "table/radius_branches.h"

namespace rheocyte {

/// Where the branches were simulated, and where the cells flow.
struct BranchConditions {
  double simulated_width_um = 0, simulated_rate_ul_s = 0, simulated_viscosity_mPas = 0;
  double channel_width_um = 0, flow_rate_ul_s = 0;
  bool is_shell = false;

  /// Width of the simulated channel over that of the cells.
  double width_ratio() const { return simulated_width_um / channel_width_um; }
  /// Flow rate times viscosity, over that of the simulations (eq:scaling).
  double load(double viscosity_mPas) const {
    return flow_rate_ul_s * viscosity_mPas / (simulated_rate_ul_s * simulated_viscosity_mPas);
  }
  /// A shape of the simulated channel in that of the cells.
  std::variant<CellShape, NoShape> in_channel(std::variant<CellShape, NoShape> found) const;
};

/// A cell is scaled to the channel of the simulations (eq:scaling; the modulus of a shell with the square of the width)
/// and found between the neighbouring radii: all measures and the points of the contour, in units of the radius, by a
/// polynomial in the radius through up to four branches at the same stiffness.
class BranchShapes : public CellShapes {
 public:
  /// At least two radii, all contours with the same points (asserted).
  BranchShapes(std::vector<SampledBranch> branches, const BranchConditions& conditions);

  std::variant<CellShape, NoShape> shape(const VirtualCell& cell) const override;
  std::string description() const override;

 private:
  std::variant<CellShape, NoShape> at(double radius_um, double stiffness) const;

  std::vector<SampledBranch> branches_;
  std::vector<RadiusBranches> radii_;
  BranchConditions conditions_;
};

}  // namespace rheocyte

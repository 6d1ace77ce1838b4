// Virtual cells by sampled branches of simulated states: interpolation between radii and stiffnesses.
#pragma once
#include <vector>

#include "case/channel_flow.h"
#include "synth/cell_shapes.h"
#include "table/radius_branches.h"

namespace rheocyte {

/// Where the branches were simulated, and where the cells flow; the viscosity there is that of each cell.
struct SimulatedCells {
  ChannelFlow simulated, flow;
  bool is_shell = false;

  /// From the channel of the simulations to that of a cell.
  ScaleFactors scale_for(const VirtualCell& cell) const {
    return scale_factors(simulated, {flow.width_um, flow.rate_ul_s, cell.viscosity_mPas});
  }
};

/// A shape of the simulated channel in that of the cells.
std::variant<CellShape, NoShape> scaled(std::variant<CellShape, NoShape> found, const ScaleFactors& scale);

/// A cell is scaled to the channel of the simulations (eq:scaling; the modulus of a shell with the square of the width)
/// and found between the neighbouring radii: all measures and the points of the contour, in units of the radius, by a
/// polynomial in the radius through up to four branches at the same stiffness.
class BranchShapes : public CellShapes {
 public:
  /// At least two radii, all contours with the same points (asserted).
  BranchShapes(std::vector<SampledBranch> branches, const SimulatedCells& cells);

  std::variant<CellShape, NoShape> shape(const VirtualCell& cell) const override;
  std::string description() const override;

 private:
  std::variant<CellShape, NoShape> at(double radius_um, double stiffness) const;

  std::vector<SampledBranch> branches_;
  std::vector<RadiusBranches> radii_;
  SimulatedCells cells_;
};

}  // namespace rheocyte

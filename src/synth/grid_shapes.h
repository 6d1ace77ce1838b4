// Virtual cells by a grid of a table: those whose moduli `rheocyte extract` reads back from the same grid.
#pragma once
#include <optional>

#include "synth/cell_shapes.h"
#include "table/stiffness_grid.h"

namespace rheocyte {

/// A cell is scaled to the channel of the grid (eq:scaling) and found there by its radius and Young's modulus. Its
/// outline has the area, the deformation and the modes c_2 to c_7 of the grid; its radius at rest is that of the sphere
/// which has the volume of the outline turned about the axis (of cells in a square channel, whose corners bulge, within
/// 0.1 %).
class GridShapes : public CellShapes {
 public:
  /// The grid must hold shapes (asserted), and its stiffness must be Young's modulus (asserted).
  GridShapes(GridContent grid, const ChannelFlow& flow);

  std::variant<CellShape, NoShape> shape(const VirtualCell& cell) const override;
  /// Of the smooth states alone.
  std::string description() const override;

 private:
  std::variant<CellShape, NoShape> at(double radius_um, double modulus_kPa) const;
  /// ln(deformation) of the smooth cell with this ln(kPa), or of the nearest one.
  double log_deformation(double log_modulus, double area_um2, const StiffnessGrid::Range& range) const;
  /// Of a cell with this area and deformation: the sum of the grid's modes, or one whose hull has what the grid says.
  Eigen::MatrixX2d outline_of(const CellShape&, bool as_seen) const;
  /// Finds area and deformation of the cell with this radius, from those of the shape on.
  std::optional<NoShape> settle(double radius_um, double log_modulus, bool as_seen, CellShape& shape) const;

  StiffnessGrid grid_;
  ShapeGrid shapes_;
  ChannelFlow flow_;  ///< of the recording; the viscosity is that of each cell
};

}  // namespace rheocyte

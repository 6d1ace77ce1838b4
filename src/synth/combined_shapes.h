// Virtual cells with bulk, cortex and tension by the branches of a combined table.
#pragma once
#include <vector>

#include "synth/branch_shapes.h"
#include "synth/cell_shapes.h"
#include "table/combined_interpolation.h"

namespace rheocyte {

/// A cell is scaled to the channel of the simulations (eq:scaling) and found in the table by its radius, fraction of
/// the cortex, tension and stiffness (eq:combined). Area and deformation are those of the table's interpolation. With
/// the contours of the branches the points, in units of the radius, are the sum of those of the same branches at the
/// same deformation, with the same weights. A table as one file has none: then the outline is the one of twelve modes
/// whose hull has the table's modes; the contour within a dent is not there, nor what the hull's corners make of higher
/// modes.
class CombinedShapes : public CellShapes {
 public:
  /// All contours with the same points (asserted). UserError: fewer than two radii or fractions.
  CombinedShapes(const TableSpec& spec, std::vector<SampledBranch> branches, const SimulatedCells& cells);
  /// By a table as one file. UserError as above.
  CombinedShapes(const CombinedTable& table, const SimulatedCells& cells);

  std::variant<CellShape, NoShape> shape(const VirtualCell& cell) const override;
  std::optional<Elongation> elongation() const override {
    return between_.is_elongated() ? std::optional(Elongation::by_tension) : std::nullopt;
  }
  std::string description() const override;
  const std::vector<double>& tension_ratios() const { return between_.tension_ratios(); }

 private:
  /// In the table's channel.
  std::variant<CellShape, NoShape> at(CellCoordinates cell, double log_stiffness) const;
  CellShape blended(const CellCoordinates& cell) const;
  CellShape by_modes(const CombinedState& state) const;

  std::vector<SampledBranch> branches_;  ///< in the order of the table's; empty: without contours
  CombinedInterpolation between_;
  SimulatedCells cells_;
};

}  // namespace rheocyte

// Virtual solids that the liquid elongates along the flow, or that are long at rest, by a table of elongated cells.
#pragma once
#include "case/channel_flow.h"
#include "synth/cell_shapes.h"
#include "table/elongated_table.h"

namespace rheocyte {

/// A cell is scaled to the channel of the table (eq:scaling) and found there by its radius, Young's modulus and the
/// axial tension or, by a table of such cells, its shape at rest. Its outline has the area and the modes c_2 to c_7 of
/// the table.
class ElongatedCellShapes : public CellShapes {
 public:
  ElongatedCellShapes(ElongatedContent content, const ChannelFlow& flow) : table_(std::move(content)), flow_(flow) {}

  std::variant<CellShape, NoShape> shape(const VirtualCell& cell) const override;
  std::optional<Elongation> elongation() const override { return table_.elongation(); }
  std::string description() const override;

 private:
  bool is_long_at_rest() const { return table_.elongation() == Elongation::by_rest_shape; }
  std::variant<CellShape, NoShape> at(double radius_um, double modulus_kPa, double axial_ratio) const;

  ElongatedTable table_;
  ChannelFlow flow_;  ///< of the recording; the viscosity is that of each cell
};

}  // namespace rheocyte

// Virtual cells on their way behind a contraction, by a dynamic table.
#pragma once
#include "case/channel_flow.h"
#include "synth/cell_shapes.h"
#include "table/dynamic_table.h"

namespace rheocyte {

/// A cell is scaled to the channel of the table (eq:scaling). Its outline is that of the modes of its hull that the
/// table has, of the table's area.
class CourseShapes : public CellShapes {
 public:
  CourseShapes(DynamicTable table, const ChannelFlow& flow) : table_(std::move(table)), flow_(flow) {}

  /// At the cell's place.
  std::variant<CellShape, NoShape> shape(const VirtualCell& cell) const override;
  std::string description() const override;

 private:
  DynamicTable table_;
  ChannelFlow flow_;  ///< of the recording; the viscosity is that of each cell
};

}  // namespace rheocyte

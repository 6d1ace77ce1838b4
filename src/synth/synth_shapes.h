// The model of shapes that a spec for virtual recordings asks for.
#pragma once
#include <memory>

#include "synth/cell_shapes.h"
#include "synth/synth_spec.h"

namespace rheocyte {

/// The analytical model, the branches in the folder of a table that `rheocyte table` has computed, or a grid; the spec
/// must name one of them (shelf/virtual_cells.h). UserError if there is no such table, or it is one of other cells.
/// The spec receives the kind of its cells, and the tension of a combined table that has one only.
std::unique_ptr<CellShapes> shapes_of(SynthSpec& spec);

}  // namespace rheocyte

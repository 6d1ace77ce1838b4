// The model of shapes that a spec for virtual recordings asks for.
#pragma once
#include <memory>

#include "synth/cell_shapes.h"
#include "synth/synth_spec.h"

namespace rheocyte {

/// The analytical model, or the branches in the folder of a table that `rheocyte table` has computed. UserError if
/// there is no such table, or it is one of other cells. Where a combined table has one tension only, the spec is given
/// it.
std::unique_ptr<CellShapes> shapes_of(SynthSpec& spec);

}  // namespace rheocyte

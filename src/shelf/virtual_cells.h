// Where virtual cells get their shapes from: by default from the table that reads their moduli.
#pragma once
#include <filesystem>
#include <memory>

#include "synth/cell_shapes.h"
#include "synth/synth_spec.h"

namespace rheocyte {

/// shapes.table as seen from the folder of the spec, a table that comes with the program, or, if the spec names none,
/// that which `rheocyte extract` takes for the liquid; then as synth/synth_shapes.h. UserError.
std::unique_ptr<CellShapes> virtual_cells(SynthSpec& spec, const std::filesystem::path& folder);

}  // namespace rheocyte

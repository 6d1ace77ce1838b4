// The median cell of a recording in words, for all commands.
#pragma once
#include <string>
#include <string_view>

#include "extract/effective_cell.h"

namespace rheocyte {

/// "area, deformation and inertia ratio", or what of these determines the cell.
std::string_view effective_data_text(const EffectiveCell& cell);

/// Of a cell that is not in the table: where it lies, as a sentence.
std::string effective_place_text(const EffectiveCell& cell);

/// Under a given tension: what the inertia ratios determine in its place, as a sentence; empty without them.
std::string by_ratios_text(const EffectiveCell& cell);

}  // namespace rheocyte

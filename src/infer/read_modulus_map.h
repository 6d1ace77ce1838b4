// A table of moduli of whichever kind.
#pragma once
#include <filesystem>
#include <memory>
#include <optional>

#include "infer/modulus_map.h"
#include "table/stiffness_grid.h"

namespace rheocyte {

/// A file in dclab's format, a grid, or the folder of a table of `rheocyte table`; of areas and of solids, else
/// UserError.
std::unique_ptr<const ModulusMap> read_modulus_map(const std::filesystem::path& path);

/// UserError if the file cannot be read or is no sound grid.
GridContent read_grid(const std::filesystem::path& file);

/// What a grid is for, without reading its numbers; nothing if the file is not a grid.
std::optional<GridHead> read_grid_head(const std::filesystem::path& grid_file);

}  // namespace rheocyte

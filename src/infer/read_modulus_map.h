// A table of moduli of whichever kind.
#pragma once
#include <filesystem>
#include <memory>
#include <optional>

#include "infer/modulus_map.h"

namespace rheocyte {

/// A file in dclab's format, a grid, or the folder of a table of `rheocyte table`; of areas and of solids, else
/// UserError.
std::unique_ptr<const ModulusMap> read_modulus_map(const std::filesystem::path& path);

/// The exponent of the liquid of a grid, without reading its numbers; nothing if the file is no grid.
std::optional<double> read_flow_exponent(const std::filesystem::path& grid_file);

}  // namespace rheocyte

// A table of whichever kind.
#pragma once
#include <filesystem>
#include <variant>

#include "infer/published_table.h"
#include "table/stiffness_grid.h"

namespace rheocyte {

using AnyTable = std::variant<PublishedTable, GridContent>;

/// A file in dclab's format, a grid, or the folder of a table of `rheocyte table`. UserError.
AnyTable read_any_table(const std::filesystem::path& path);

}  // namespace rheocyte

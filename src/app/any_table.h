// A table of whichever kind.
#pragma once
#include <filesystem>
#include <optional>
#include <variant>

#include "infer/published_table.h"
#include "table/stiffness_grid.h"

namespace rheocyte {

using AnyTable = std::variant<PublishedTable, GridContent>;

/// A file in dclab's format, a grid, or the folder of a table of `rheocyte table`. UserError.
AnyTable read_any_table(const std::filesystem::path& path);

/// The identifier of the table that is taken when none is named.
inline constexpr const char* standard_table = "LE-2D-26";

/// Its file; nothing if it is missing.
std::optional<std::filesystem::path> standard_table_file();

}  // namespace rheocyte

#include "infer/read_modulus_map.h"

#include <fmt/format.h>

#include <string>
#include <system_error>

#include "case/refuse_path.h"
#include "case/user_error.h"
#include "infer/grid_map.h"
#include "infer/published_map.h"
#include "store/read_file.h"
#include "table/origin_record.h"
#include "table/table_files.h"

namespace rheocyte {

namespace {

namespace fs = std::filesystem;

// The grid in the folder of a table.
fs::path grid_in(const fs::path& folder) {
  const auto found = table_files(folder, "grid");
  const std::string name = one_line(folder.string(), 300);
  if (found.empty())
    throw UserError(
        fmt::format("{}: this folder contains no grid_*.cbor, which `rheocyte table` writes when a table is complete; "
                    "give --table the folder of a complete table, or a file.",
                    name));
  if (found.size() > 1)
    throw UserError(fmt::format("{}: contains several grid_*.cbor; give --table one of them.", name));
  return found.begin()->second;
}

}  // namespace

GridContent read_grid(const fs::path& file) {
  return grid_from_bytes(content_of_file(file, largest_grid), one_line(file.string(), 300));
}

std::unique_ptr<const ModulusMap> read_modulus_map(const fs::path& path) {
  std::error_code error;
  const fs::path file = fs::is_directory(path, error) ? grid_in(path) : path;
  if (file.extension() == ".cbor") return std::make_unique<GridMap>(read_grid(file));
  PublishedTable table = read_published_table(file);
  refuse_volumes(table);
  return std::make_unique<PublishedMap>(std::move(table));
}

std::optional<GridHead> read_grid_head(const fs::path& grid_file) {
  return grid_head(first_bytes(grid_file, grid_head_bytes).value_or(""));
}

}  // namespace rheocyte

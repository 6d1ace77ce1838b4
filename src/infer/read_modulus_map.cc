#include "infer/read_modulus_map.h"

#include <fmt/format.h>

#include <fstream>
#include <iterator>
#include <string>
#include <system_error>
#include <vector>

#include "case/refuse_path.h"
#include "case/user_error.h"
#include "infer/grid_map.h"
#include "infer/published_map.h"

namespace rheocyte {

namespace {

namespace fs = std::filesystem;

// The grid in the folder of a table.
fs::path grid_in(const fs::path& folder) {
  std::vector<fs::path> found;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error))
    if (entry.path().extension() == ".cbor" && entry.path().filename().string().starts_with("grid_"))
      found.push_back(entry.path());
  const std::string name = one_line(folder.string(), 300);
  if (found.empty())
    throw UserError(
        fmt::format("{}: this folder holds no grid_*.cbor, which `rheocyte table` writes when a table is "
                    "complete; give --table the folder of a complete table, or a file.",
                    name));
  if (found.size() > 1) throw UserError(fmt::format("{}: holds several grid_*.cbor; give --table one of them.", name));
  return found.front();
}

std::string content_of(const fs::path& path) {
  constexpr std::uintmax_t max_file = 64 << 20;
  std::error_code error;
  const auto size = fs::file_size(path, error);
  std::ifstream file(path, std::ios::binary);
  if (error || !file || size > max_file)
    refuse_path(path, !error && size > max_file ? "is too large for a grid of a table."
                                                : "cannot be read; check its permissions.");
  return {std::istreambuf_iterator<char>(file), {}};
}

}  // namespace

GridContent read_grid(const fs::path& file) { return grid_from_bytes(content_of(file), one_line(file.string(), 300)); }

std::unique_ptr<const ModulusMap> read_modulus_map(const fs::path& path) {
  std::error_code error;
  const fs::path file = fs::is_directory(path, error) ? grid_in(path) : path;
  if (file.extension() == ".cbor") return std::make_unique<GridMap>(read_grid(file));
  PublishedTable table = read_published_table(file);
  refuse_volumes(table);
  return std::make_unique<PublishedMap>(std::move(table));
}

std::optional<GridHead> read_grid_head(const fs::path& grid_file) {
  std::string head(grid_head_bytes, '\0');
  std::ifstream file(grid_file, std::ios::binary);
  file.read(head.data(), static_cast<std::streamsize>(head.size()));
  head.resize(static_cast<std::size_t>(file.gcount()));
  return grid_head(head);
}

}  // namespace rheocyte

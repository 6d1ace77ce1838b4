// Gives a grid the shapes of its cells from a table of the same spec with other radii: add_shapes GRID FOLDER
//
// Shapes are smooth over area and deformation: a tenth of the radii that a modulus needs is enough for them. The table
// may still be growing; GRID is replaced. Prints how many radii there are, and by how much the shapes change without
// every other one of them.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>

#include "bare_branches.h"
#include "case/user_error.h"
#include "program.h"
#include "table/shapes_from_branches.h"

namespace {

using namespace rheocyte;

std::vector<SampledBranch> finished(const TableFolder& folder) {
  std::vector<SampledBranch> branches = bare_branches(folder);
  std::erase_if(branches, [](const SampledBranch& branch) { return branch.samples() < 2; });
  std::ranges::sort(branches, {}, &SampledBranch::radius_um);
  return branches;
}

std::vector<SampledBranch> every_other(const std::vector<SampledBranch>& all) {
  std::vector<SampledBranch> some;
  for (std::size_t i = 0; i < all.size(); i += 2) some.push_back(all[i]);
  if (all.size() % 2 == 0) some.push_back(all.back());
  return some;
}

void compare(const ShapeGrid& fine, const ShapeGrid& coarse) {
  double ratio = 0, asymmetry = 0, at_ratio = 0, at_asymmetry = 0;
  const ShapeNodes& n = fine.nodes();
  for (double column = 0; column <= n.columns - 1; column += 0.25)
    for (double log_d = n.lower.front(); log_d < std::log(0.06); log_d += 0.1) {
      const auto c = std::size_t(column);
      if (log_d > n.upper[c] || log_d > n.upper[std::min(c + 1, n.upper.size() - 1)]) continue;
      const double area = n.min_log_area + column * n.column_step, d = std::exp(log_d);
      const double by_ratio = std::abs(fine.inertia_ratio(area, d) - coarse.inertia_ratio(area, d));
      const double by_mode = std::abs(coarse.mode(3, area, d) / fine.mode(3, area, d) - 1);
      if (by_ratio > ratio) ratio = by_ratio, at_ratio = d;
      if (by_mode > asymmetry) asymmetry = by_mode, at_asymmetry = d;
    }
  fmt::print(
      "every other radius: inertia ratio off by at most {:.1e} (d = {:.3g}), c_3 by {:.1e} of itself (d = {:.3g})\n",
      ratio, at_ratio, asymmetry, at_asymmetry);
}

}  // namespace

int rheocyte::measure(int argc, char** argv) {
  if (argc < 3) return fmt::print("add_shapes GRID FOLDER\n"), 2;
  std::ifstream file(argv[1], std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(file), {}};
  GridContent grid = grid_from_bytes(bytes, argv[1]);
  const TableFolder folder(argv[2], read_table_spec(std::string(argv[2]) + "/spec.toml"));
  const auto branches = finished(folder);
  const auto fine = shapes_from_branches(grid, branches), coarse = shapes_from_branches(grid, every_other(branches));
  if (!fine) throw UserError(fmt::format("{}: too few branches.", argv[2]));
  fmt::print("{}: shapes of {} radii\n", grid.origin.identifier, branches.size());
  if (coarse) compare(ShapeGrid(*fine), ShapeGrid(*coarse));
  grid.shapes = *fine;
  std::ofstream(argv[1], std::ios::binary | std::ios::trunc) << to_bytes(grid);
  return 0;
}

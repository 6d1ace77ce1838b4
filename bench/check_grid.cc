// How well the structured grid of a finished table repeats the interpolation between its branches: check_grid DIR
// [GRID]
//
// At random areas and deformations, uniform in their logarithms, both answer. With a file of a grid it is said whether
// that is the table's.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fstream>
#include <iterator>
#include <map>
#include <random>
#include <vector>

#include "numeric/quantile.h"
#include "program.h"
#include "table/grid_from_branches.h"
#include "table/table_folder.h"
#include "table/table_interpolation.h"

namespace {

using namespace rheocyte;

void print_differences(const char* what, const std::vector<double>& all) {
  if (all.empty()) return;
  const auto at = [&](double share) { return quantile(all, share); };
  fmt::print("{}: {} points, median {:.1e}, 95 % {:.1e}, 99.9 % {:.1e}, greatest {:.1e}\n", what, all.size(), at(0.5),
             at(0.95), at(0.999), at(1));
}

}  // namespace

int rheocyte::measure(int argc, char** argv) {
  if (argc < 2) return fmt::print("check_grid DIR [GRID]\n"), 2;
  const TableSpec spec = read_table_spec(std::string(argv[1]) + "/spec.toml");
  const auto branches = TableFolder(argv[1], spec).all_branches();
  const auto start = std::chrono::steady_clock::now();
  const auto content = make_stiffness_grid(spec, branches, "check");
  if (!content) return fmt::print("the table has too few states for a grid\n"), 1;
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
  fmt::print("made in {:.2f} s, {} kB\n", seconds.count(), to_bytes(*content).size() / 1024);
  for (const auto& patch : content->patches)
    fmt::print("{} x {} nodes from column {}{}\n", patch.columns, patch.rows, patch.first_column,
               patch.regularised ? ", regularised" : "");
  if (argc > 2) {
    std::ifstream file(argv[2], std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(file), {}};
    GridContent same = *content;
    same.origin.program = grid_from_bytes(bytes, argv[2]).origin.program;
    fmt::print("{} is {}this table's grid\n", argv[2], to_bytes(same) == bytes ? "" : "not ");
  }
  const StiffnessGrid grid(*content);
  const TableInterpolation table(spec, branches);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> area(std::log(spec.min_area_um2), std::log(spec.max_area_um2)),
      deformation(std::log(spec.min_deformation), std::log(spec.max_deformation));
  std::vector<double> bare, held, usual;
  std::map<std::pair<std::string, std::string>, int> disagreements;
  double worst = 0, worst_held = 0;
  int beyond_error = 0;
  for (int i = 0; i < 200000; ++i) {
    const double a = std::exp(area(random)), d = std::exp(deformation(random));
    const auto exact = table.by_area(a, d);
    const auto ours = grid.answer(a, d);
    const bool has = exact.reason == NoAnswer::none;
    if (has && ours.reason == NoAnswer::none && exact.regularised == ours.regularised) {
      const double difference = std::abs(std::exp(ours.log_stiffness) / exact.stiffness - 1);
      (ours.regularised ? held : bare).push_back(difference);
      if (!ours.regularised && d > 0.003 && d < 0.1) usual.push_back(difference);
      if (ours.regularised && difference > 3 * ours.error)
        ++beyond_error, worst_held = std::max(worst_held, difference / ours.error);
      fmt::print("  held {:.4g} {:.4g}: grid {:.4g} table {:.4g}, errors {:.2e} {:.2e}\n", a, d,
                 std::exp(ours.log_stiffness), exact.stiffness, ours.error, exact.error);
      if (!ours.regularised && difference > worst) {
        worst = difference;
        fmt::print("  {:.1e} at {:.4g} um2, deformation {:.4g}, errors stated {:.1e} and {:.1e}\n", worst, a, d,
                   exact.error, ours.error);
      }
    } else {
      const auto name = [](NoAnswer reason, bool regularised) {
        return reason == NoAnswer::none ? std::string(regularised ? "regularised" : "bare")
                                        : std::string(name_of(reason));
      };
      const std::pair key{name(exact.reason, exact.regularised), name(ours.reason, ours.regularised)};
      if (key.first != key.second) ++disagreements[key];
    }
  }
  print_differences("bare surface", bare);
  print_differences("of these, deformations of 0.003 to 0.1", usual);
  print_differences("regularised", held);
  fmt::print("regularised, beyond three stated errors: {} of {}, at most {:.1f} of them\n", beyond_error, held.size(),
             worst_held);
  for (const auto& [names, count] : disagreements)
    fmt::print("{:.3f} %: {} between the branches, {} in the grid\n", count / 2000.0, names.first, names.second);
  return 0;
}

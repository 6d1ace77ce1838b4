// How good a finished table is between its rows: check_table DIR [POINTS]
//
// Cells of random radius and deformation inside the table's ranges are solved directly at accuracy 1e-5; the stiffness
// that the table gives for their area and deformation is compared with theirs.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <random>
#include <vector>

#include "case/scales.h"
#include "numeric/quantile.h"
#include "program.h"
#include "solve/stationary.h"
#include "table/table_folder.h"
#include "table/table_interpolation.h"

namespace {

using namespace rheocyte;

/// A stiffness that makes about this deformation at this radius; 0 if none does.
double guess_stiffness(const std::vector<SampledBranch>& branches, double radius, double deformation) {
  const SampledBranch* nearest = &branches.front();
  for (const SampledBranch& branch : branches) {
    if (branch.bending_kBT == 0 && std::abs(branch.radius_um - radius) < std::abs(nearest->radius_um - radius))
      nearest = &branch;
  }
  const double stiffness = stiffness_at(*nearest, Measure::deformation, deformation);
  return std::isfinite(stiffness) ? stiffness : 0;
}

}  // namespace

int rheocyte::measure(int argc, char** argv) {
  if (argc < 2) return fmt::print("check_table DIR [POINTS]\n"), 2;
  const TableSpec spec = read_table_spec(std::string(argv[1]) + "/spec.toml");
  auto branches = TableFolder(argv[1], spec).all_branches();
  std::erase_if(branches, [](const SampledBranch& branch) { return branch.empty(); });
  const TableInterpolation table(spec, branches);
  const int points = argc > 2 ? std::atoi(argv[2]) : 200;
  std::mt19937 engine(1);
  const auto random = [&](double low, double high) { return std::uniform_real_distribution(low, high)(engine); };
  std::vector<double> differences;
  int beyond = 0;
  for (int tries = 0; int(differences.size()) < points && tries < 5 * points; ++tries) {
    const double radius = random(branches.front().radius_um, branches.back().radius_um);
    const double deformation = std::exp(random(std::log(2 * spec.min_deformation), std::log(spec.max_deformation)));
    const double stiffness = guess_stiffness(branches, radius, deformation);
    if (stiffness == 0) continue;
    const Case cell = case_at(spec, {radius}, stiffness);
    Problem problem = problem_of(cell);
    problem.accuracy = 1e-5;
    const StationaryState state = solve_stationary(problem);
    if (state.outcome.status != Status::converged) {
      ++beyond;
      continue;
    }
    const double um = 1e6 * scales_of(cell).length_m, area = state.shape.area * um * um;
    const StiffnessAnswer answer = table.by_area(area, state.shape.deformation);
    if (answer.reason != OutOfTable::none || answer.regularised) continue;
    differences.push_back(std::abs(answer.stiffness / stiffness - 1));
    if (differences.back() > 1e-3)
      fmt::print("area {:.4g}, deformation {:.5g}: stiffness off by {:.2e}, estimated {:.1e}\n", area,
                 state.shape.deformation, differences.back(), answer.error);
  }
  if (differences.empty()) return fmt::print("no point lies in the table\n"), 1;
  fmt::print("{} points, median {:.2e}, 95 % below {:.2e}, greatest {:.2e}; {} beyond the smooth branch\n",
             differences.size(), quantile(differences, 0.5), quantile(differences, 0.95), std::ranges::max(differences),
             beyond);
  return 0;
}

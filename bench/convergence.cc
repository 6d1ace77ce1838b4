// How the deformation converges with degree and mesh for one cell, as a table in CSV on standard output:
//
//     build/convergence > convergence.csv
//     PYTHONPATH=python python3 -m rheocyte.convergence convergence.csv docs/figures/convergence.png
//
// r0 = 6 um, E = 2.29 kPa, `linear`, Stokes, in the standard channel. The reference is the finest row, without an
// error.
#include <fmt/format.h>

#include <cstdlib>
#include <numbers>
#include <string>
#include <vector>

#include "program.h"
#include "solve/resolved_branch.h"
#include "solve/tube.h"

namespace {

using namespace rheocyte;

struct Series {
  std::string name;
  Subdivision subdivision;
  int first_degree, last_degree;
};
const std::vector<Series> all_series = {
    {"2 x 4 elements", {2, 4, 1, 2}, 2, 9}, {"3 x 6", {3, 6, 1, 2}, 2, 8}, {"4 x 8", {4, 8, 2, 2}, 2, 7}};
const Series reference{"reference", {4, 8, 2, 2}, 10, 10};

struct Row {
  std::string series;
  int degree, unknowns;
  double deformation;
};

Problem standard_cell() {
  Problem problem;
  problem.radius_ratio = 6 / 10.94;
  constexpr double R = 10.94e-6, Q = 0.04e-9, viscosity = 15e-3, E = 2290;  // SI
  problem.bulk.shear_modulus = std::numbers::pi * E * R * R * R / (3 * viscosity * Q);
  problem.bulk.law = BulkLaw::linear;
  return problem;
}

/// A row for each degree at which the state exists.
void solve(const Problem& problem, ResolvedBranch& branch, const ResolvedState& start, const Series& series,
           std::vector<Row>& rows) {
  for (int degree = series.first_degree; degree <= series.last_degree; ++degree) {
    const ResolvedState state = branch.at_resolution(start, {series.subdivision, degree});
    if (state.status != Status::converged || state.branch.parameter < 1) {
      fmt::print(stderr, "{}, degree {}: {}\n", series.name, degree, name(state.status));
      continue;
    }
    rows.push_back({series.name, degree, int(state.branch.unknowns.size()),
                    state.discrete->deformation(problem, state.branch.unknowns)});
  }
}

}  // namespace

int rheocyte::measure(int, char**) {
  const Problem problem = standard_cell();
  Geometry tube = tube_geometry(problem);
  tube.fine.tolerance = 1e-12;
  ResolvedBranch branch(problem, tube);
  const ResolvedState start = branch.follow();
  std::vector<Row> rows;
  solve(problem, branch, start, reference, rows);
  if (start.status != Status::converged || rows.empty()) return EXIT_FAILURE;
  const double limit = rows.front().deformation;
  for (const Series& series : all_series) solve(problem, branch, start, series, rows);

  fmt::print("series,degree,unknowns,deformation,error\n");
  for (const Row& row : rows) {
    const std::string error = row.series == reference.name ? "" : fmt::format("{:.3e}", row.deformation / limit - 1);
    fmt::print("{},{},{},{:.12f},{}\n", row.series, row.degree, row.unknowns, row.deformation, error);
  }
  return 0;
}

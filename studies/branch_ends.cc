// Where the branches of bare solids in a Newtonian liquid end, for the table in src/solve/branch_ends.cc.
//
//     build/branch_ends > ends.csv
//
// Columns: law, r0 / R, ln(mu / S / (r0 / R)), deformation and least stretch ratio of the last state. Some minutes.
#include <fmt/format.h>

#include <cmath>
#include <cstdio>

#include "solve/resolved_branch.h"
#include "solve/tube.h"

namespace rheocyte {
namespace {

void print_end(BulkLaw law, double radius_ratio) {
  Problem problem;
  problem.radius_ratio = radius_ratio;
  const bool neo_hookean = law == BulkLaw::neo_hookean;
  problem.bulk = {law, 0.6 * radius_ratio, neo_hookean ? 1.0 : 0.0};
  ResolvedBranch branch(problem, tube_geometry(problem));
  const ResolvedState end = branch.follow(Search::thorough);
  StationaryState last;
  end.discrete->describe(branch.problem_at(end.branch.parameter), end.branch.unknowns, last);
  fmt::print("{},{:.3f},{:.5f},{:.4f},{:.4f}\n", neo_hookean ? "neo-hookean" : "linear", radius_ratio,
             std::log(problem.bulk.shear_modulus / end.branch.parameter / radius_ratio), last.shape.deformation,
             last.biot_ratio);
  std::fflush(stdout);
}

}  // namespace
}  // namespace rheocyte

int main() {
  using namespace rheocyte;
  for (const BulkLaw law : {BulkLaw::linear, BulkLaw::neo_hookean}) {
    for (int i = 1; i <= 19; ++i) print_end(law, 0.05 * i);
  }
  for (const double radius_ratio : {0.57, 0.59}) print_end(BulkLaw::linear, radius_ratio);
}

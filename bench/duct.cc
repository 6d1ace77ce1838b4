// What one Newton iteration in the square channel costs, by polynomial degree, and what a whole state costs. Processor
// times of one thread; `gflop/s` of a product of large matrices in the same run says what the machine can do.
//
//   bench_duct            the table of iterations, then five states
#include "solve/duct.h"

#include <fmt/format.h>

#include <algorithm>
#include <ctime>

#include "solve/stationary.h"

namespace {

using namespace rheocyte;

double processor_seconds() { return double(std::clock()) / CLOCKS_PER_SEC; }

/// Seconds of an action, the least of some runs.
template <class Action>
double seconds(int runs, const Action& action) {
  double least = 1e300;
  for (int run = 0; run < runs; ++run) {
    const double start = processor_seconds();
    action();
    least = std::min(least, processor_seconds() - start);
  }
  return least;
}

/// r0 = 6 um, neo-Hookean, in the channel of 20 um at 0.04 ul/s of 15 mPa s.
Problem standard_cell(double young_modulus_kPa) {
  Problem problem;
  problem.section = Section::square;
  problem.radius_ratio = 0.6;
  problem.bulk.shear_modulus = 1e3 * young_modulus_kPa / 3 / 150;
  return problem;
}

void print_iteration(int degree) {
  const Problem problem = standard_cell(4);
  std::unique_ptr<DuctDiscrete> discrete;
  const double set_up =
      seconds(1, [&] { discrete = std::make_unique<DuctDiscrete>(problem, DuctSubdivision{}, degree); });
  DuctSystem& system = discrete->system();
  VectorXd x = system.sphere(), r;
  const int runs = degree < 6 ? 3 : 1;
  const double tangent = seconds(runs, [&] { r = system.linearise(problem, x).value; });
  const double residual = seconds(runs, [&] { system.residual(problem, x); });
  const double solve = seconds(runs, [&] { system.solve(r); });
  fmt::print("| {} | {} | {} | {:.2g} | {:.2g} | {:.3f} | {:.3f} | {:.3f} | {:.3f} |\n", degree,
             discrete->space().elements().size(), discrete->space().unknowns(), system.factorisation_flops(),
             system.factor_entries(), set_up, tangent, residual, solve);
}

void print_state(double young_modulus_kPa, double accuracy) {
  Problem problem = standard_cell(young_modulus_kPa);
  problem.accuracy = accuracy;
  StationaryState state;
  const double s = seconds(1, [&] { state = solve_stationary(problem); });
  fmt::print("| {} | {:g} | {:.7f} | {:.1e} | {} | {} | {} | {:.2f} |\n", young_modulus_kPa, accuracy,
             state.deformation_side, state.estimated_error, state.statistics.degree, state.statistics.newton_iterations,
             state.statistics.factorisations, s);
  std::fflush(stdout);
}

}  // namespace

int main() {
  const MatrixXd a = MatrixXd::Random(1000, 1000), b = MatrixXd::Random(1000, 1000);
  MatrixXd c(1000, 1000);
  fmt::print("gflop/s {:.1f}\n\n", 2 / seconds(5, [&] { c.noalias() = a * b; }));
  fmt::print("| p | hexahedra | unknowns | flops | L + U | set-up (s) | tangent (s) | residual (s) | solve (s) |\n");
  for (const int degree : {3, 4, 5, 6}) print_iteration(degree);
  fmt::print("\n| E (kPa) | accuracy | d | estimated | degree | iterations | factorisations | time (s) |\n");
  for (const double accuracy : {1e-2, 1e-3}) {
    for (const double modulus : {8.0, 4.0, 2.5}) print_state(modulus, accuracy);
  }
}

// What one Newton iteration costs, by polynomial degree, and what of it is numeric factorisation; and what a state
// costs that is reached from its neighbour, by what the cell is made of.
//
// Columns: a whole iteration (integrals with tangent, factorisation, substitution, one residual), then its parts.
// `iteration/factorisation` is how many factorisations an iteration costs.
#include <benchmark/benchmark.h>

#include "solve/resolved_branch.h"

namespace {

using namespace rheocyte;

/// r0 = 6 um, E = 4.58 kPa, `linear`, in the standard channel (R = 10.94 um, 0.04 ul/s, 15 mPa s, Stokes).
Problem standard_cell() {
  Problem problem;
  problem.radius_ratio = 6 / 10.94;
  problem.bulk.shear_modulus = 4580.0 / 3 / 145.864;
  problem.bulk.law = BulkLaw::linear;
  return problem;
}

void newton_iteration(benchmark::State& state) {
  const Problem problem = standard_cell();
  const Media media = media_at(problem, 1);
  const Resolution resolution{{2, 4, 1, 2}, int(state.range(0))};
  Discrete discrete(problem, resolution);
  StationarySystem& system = discrete.system;
  VectorXd unknowns = system.sphere();
  newton(system, media_at(problem, 0.5), NewtonOptions{}, unknowns);

  const WorkMeter before = system.work();
  double det = 0;
  bool factorised = false;
  for (auto _ : state) {
    const VectorXd residual = system.linearise(media, unknowns, det, factorised);
    const VectorXd correction = system.solve(-residual);
    benchmark::DoNotOptimize(system.residual(media, unknowns + 1e-3 * correction, det).data());
  }
  const WorkMeter& after = system.work();
  const double n = double(state.iterations()) * 1e-3;  // counters in ms
  const double assembly = after.assembly_s - before.assembly_s, solve = after.substitution_s - before.substitution_s;
  const double elimination = after.factorisation_s - before.factorisation_s;
  state.counters["unknowns"] = discrete.space.unknowns();
  state.counters["Mflop"] = 1e-6 * system.factorisation_flops();
  state.counters["assembly_ms"] = assembly / n;
  state.counters["elimination_ms"] = elimination / n;
  state.counters["substitution_ms"] = solve / n;
  state.counters["iteration/factorisation"] = (assembly + elimination + solve) / elimination;
}

/// From the state at 0.95 of the compliance to the wanted one, at degree 6. 0: solid, 1: solid with cortex and tension,
/// 2: the same with bending, 3: shell.
void warm_started_state(benchmark::State& state) {
  Problem problem = standard_cell();
  const int kind = int(state.range(0));
  if (kind >= 1) {
    problem.cortex.law = CortexLaw::neo_hookean;
    problem.cortex.modulus = 2;
    problem.cortex.tension = 0.2;
  }
  if (kind == 2) problem.cortex.bending = 0.01;
  if (kind == 3) {
    problem.bulk.law = BulkLaw::none;
    problem.bulk.shear_modulus = 0;
    problem.cortex.modulus = 40;
    problem.cortex.tension = 4;
  }
  Discrete discrete(problem, {{2, 4, 1, 2}, 6});
  StationarySystem& system = discrete.system;
  ContinuationReport start = start_branch(stiffness_path(system, problem), {});
  Path path = stiffness_path(system, problem);
  path.end = 0.95;
  const BranchState neighbour = continue_branch(path, {}, start.last).last;
  path.end = 1;
  NewtonReport report;
  for (auto _ : state) {
    VectorXd unknowns = neighbour.unknowns + (1 - neighbour.parameter) * neighbour.tangent;
    report = newton(system, path.media(1), {}, unknowns);
  }
  if (report.status != Status::converged) state.SkipWithError(name(report.status));
  state.counters["iterations"] = report.iterations;
  state.counters["unknowns"] = discrete.space.unknowns();
}

BENCHMARK(warm_started_state)->DenseRange(0, 3)->Unit(benchmark::kMillisecond);
BENCHMARK(newton_iteration)->DenseRange(3, 9)->Unit(benchmark::kMillisecond);

}  // namespace

BENCHMARK_MAIN();

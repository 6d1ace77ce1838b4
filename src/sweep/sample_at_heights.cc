#include "sweep/sample_at_heights.h"

#include <algorithm>
#include <chrono>

#include "case/scales.h"
#include "numeric/lagrange.h"
#include "solve/branch_samples.h"
#include "sweep/measured_state.h"
#include "table/branch_curve.h"

namespace rheocyte {
namespace {

/// Of elongated cells. In units of 1 / S, far below the compliance of cells whose asymmetry can be seen.
constexpr double margin_of_elongated = 0.2, first_compliance_of_elongated = 4e-4;

/// Fractions of sqrt(d) at the last state: the points of Chebyshev's polynomials between the least one and 1.
std::vector<double> heights(int count) {
  constexpr double least = 0.05;
  return chebyshev_points(least, 1, count);
}

/// Elongated cells are deformed where nothing flows, too, and large ones of them change in other ways than their
/// deformation where their surface nears its limit: their branches end at a margin from it that changes smoothly from
/// one branch to the next.
SamplingWay way_of(const TableSpec& spec) {
  SamplingWay way{.max_deformation = spec.max_deformation,
                  .least_margin = spec.bending_from_margin,
                  .heights = heights(spec.computed_states.value())};
  if (!spec.is_elongated()) return way;
  way.max_deformation = 1;
  way.least_margin = margin_of_elongated;
  way.height = SamplingWay::Height::compliance;
  way.first_compliance = first_compliance_of_elongated;
  return way;
}

}  // namespace

SampledBranch sample_at_heights(const TableSpec& spec, const SweepPoint& place, const std::atomic<bool>* stop) {
  const auto start = std::chrono::steady_clock::now();
  // Any stiffness: that of the liquid's stress makes the first states of the branch stiffer by a factor of 10 to 100.
  const Scales scales = scales_of(case_at(spec, place, 1));
  const double stiffness = 1e-3 * scales.stress_Pa;
  const SamplingWay way = way_of(spec);
  const auto problem_at = [&](double compliance) {
    // The elongation comes first, the flow's part after it.
    SweepPoint on_the_way = place;
    on_the_way.axial_ratio *= std::min(compliance / way.first_compliance, 1.0);
    return problem_of(case_at(spec, on_the_way, stiffness / compliance));
  };
  const Problem problem = problem_at(1);
  const auto found = branch_samples(problem, problem_at, way, stop);

  SampledBranch branch;
  branch.radius_um = place.radius_um;
  branch.axial_ratio = place.axial_ratio;
  const Status end = stop && *stop ? Status::stopped : found.end;
  const bool covers = end == Status::converged || (spec.is_elongated() && end == Status::surface_unstable);
  branch.end = end_of(covers ? Status::covered : end);
  branch.value.resize(std::ssize(found.states), measure_count);
  for (const StationaryState& state : found.states) {
    MeasuredState measured = measure_state(state, scales);
    branch.value.row(branch.samples()) = measured.value.transpose();
    branch.stiffness.push_back(stiffness / state.outcome.reached);
    branch.contour.push_back(std::move(measured.contour));
    branch.error.push_back(state.estimated_error);
    branch.newton_iterations += state.statistics.newton_iterations;
    branch.factorisation_seconds += state.statistics.factorisation_s;
  }
  branch.solves = branch.samples();
  std::vector<double> compliance;
  for (const double modulus : branch.stiffness) compliance.push_back(1 / modulus);
  set_slopes(branch, spec.is_elongated() ? compliance : roots_of_deformation(branch));
  branch.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return branch;
}

}  // namespace rheocyte

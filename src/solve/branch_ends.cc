#include "solve/branch_ends.h"

#include <algorithm>
#include <cmath>
#include <span>

namespace rheocyte {
namespace {

/// r0 / R, and ln(mu / S / (r0 / R)) of the softest cell: of a small cell the modulus is proportional to its radius.
/// By search to 0.2 % of the compliance (studies/branch_ends.cc). The branch of linear cells ends otherwise above 0.55:
/// further elongated, behind the place where it first comes near Biot's limit.
struct End {
  double radius_ratio, log_modulus;
};
constexpr End linear[] = {{0.05, 1.6781}, {0.1, 1.6769}, {0.15, 1.6817}, {0.2, 1.6875}, {0.25, 1.6985}, {0.3, 1.7124},
                          {0.35, 1.7294}, {0.4, 1.7491}, {0.45, 1.7667}, {0.5, 1.7745}, {0.55, 1.7570}, {0.57, 1.7105},
                          {0.59, 1.6547}, {0.6, 1.6562}, {0.65, 1.6614}, {0.7, 1.6732}, {0.75, 1.6921}, {0.8, 1.7201},
                          {0.85, 1.7570}, {0.9, 1.8072}, {0.95, 1.8717}};
constexpr End neo_hookean[] = {{0.05, 2.0049}, {0.1, 2.0060},  {0.15, 2.0027}, {0.2, 2.0008},  {0.25, 2.0006},
                               {0.3, 1.9971},  {0.35, 1.9928}, {0.4, 1.9918},  {0.45, 1.9917}, {0.5, 1.9871},
                               {0.55, 1.9835}, {0.6, 1.9784},  {0.65, 1.9649}, {0.7, 1.9393},  {0.75, 1.9038},
                               {0.8, 1.8608},  {0.85, 1.8209}, {0.9, 1.7857},  {0.95, 1.7614}};

/// Moduli below this fraction of the least one are refused: far outside the table's error, and what inertia changes.
constexpr double far = 0.85, max_reynolds = 0.3;
/// Where the last state is looked for, above the end and the table's error.
constexpr double above_end = 1.03;

double interpolate(std::span<const End> ends, double radius_ratio) {
  const auto inner = ends.subspan(1, ends.size() - 2);
  const auto above = std::ranges::lower_bound(inner, radius_ratio, {}, &End::radius_ratio);
  const End *b = ends.data() + 1 + (above - inner.begin()), *a = b - 1;
  const double fraction = (radius_ratio - a->radius_ratio) / (b->radius_ratio - a->radius_ratio);
  return radius_ratio * std::exp(std::lerp(a->log_modulus, b->log_modulus, fraction));
}

}  // namespace

std::optional<double> min_shear_modulus(const Problem& problem) {
  const Cortex& cortex = problem.cortex;
  const bool is_bare = cortex.law == CortexLaw::none && cortex.tension == 0 && cortex.bending == 0;
  const bool is_elongated = problem.bulk.rest_stretch != 1 || problem.bulk.axial_tension != 0;
  if (!is_bare || is_elongated || problem.liquid.law != LiquidLaw::newtonian ||
      problem.liquid.reynolds > max_reynolds || problem.drive != Drive::rate || !(problem.radius_ratio > 0))
    return std::nullopt;
  switch (problem.bulk.law) {
    case BulkLaw::linear: return interpolate(linear, problem.radius_ratio);
    case BulkLaw::neo_hookean: return interpolate(neo_hookean, problem.radius_ratio);
    default: return std::nullopt;
  }
}

bool is_far_too_soft(const Problem& problem) {
  const auto least = min_shear_modulus(problem);
  return least && problem.bulk.shear_modulus < far * *least;
}

Problem at_end_of_branch(const Problem& problem) {
  Problem end = problem;
  end.bulk.shear_modulus = above_end * min_shear_modulus(problem).value();
  return end;
}

}  // namespace rheocyte

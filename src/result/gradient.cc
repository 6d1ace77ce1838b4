#include "result/gradient.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "case/case_line.h"
#include "case/scales.h"

namespace rheocyte {
namespace {

/// Whether values at equal steps do not lie on a smooth curve: the steps are as short as rounding allows, so that two
/// changes are equal up to a few 1e-5 of them, and to rounding.
bool is_jump(double before, double middle, double after, double size) {
  constexpr double of_changes = 0.1, of_rounding = 1e-8;
  const double one = middle - before, other = after - middle;
  return std::abs(other - one) > std::max(of_changes * std::max(std::abs(one), std::abs(other)), of_rounding * size);
}

/// Of a measure at the three places of a line; of two, the state itself lies between them.
bool jumps(const StateMeasure& measure, const Result& result, const ProblemLine& line) {
  const auto at = [&](std::size_t k) { return measure.value(line[k].state); };
  const double here = measure.value(result.state), size = std::max(1.0, std::abs(here));  // rounding is that of 1
  return line.size() == 2 ? is_jump(at(0), here, at(1), size) : is_jump(at(0), at(1), at(2), size);
}

/// Weighted sums of the numbers along a line, in physical units.
Gradient gradient_along(std::string_view key, const std::vector<CasePoint>& cases, const Result& result,
                        const ProblemLine& line) {
  Gradient gradient{key, Eigen::VectorXd::Constant(std::ssize(state_measures), line.empty() ? no_value : 0), {}};
  for (std::size_t k = 0; k < line.size(); ++k) {
    const Scales scales = scales_of(cases[k].input);
    const StationaryState& state = line[k].state;
    for (Eigen::Index i = 0; i < gradient.measures.size(); ++i)
      gradient.measures(i) += line[k].weight * state_measures[i].physical(state, scales);
    const auto columns = contour_fields();
    if (k == 0) gradient.surface.setZero(state.surface.point.rows(), Eigen::Index(columns.size()));
    for (Eigen::Index j = 0; j < gradient.surface.cols(); ++j) {
      const double unit = line[k].weight * dimensionless_one(unit_of(columns[j].name), scales);
      for (Eigen::Index i = 0; i < gradient.surface.rows(); ++i)
        gradient.surface(i, j) += unit * columns[j].value({state.surface, i});
    }
  }
  for (Eigen::Index i = 0; i < gradient.measures.size() && !line.empty(); ++i)
    if (jumps(state_measures[i], result, line)) gradient.measures(i) = no_value;
  return gradient;
}

}  // namespace

std::string missing_gradients(const Result& result) {
  if (result.state.outcome.status != Status::converged) return {};
  std::vector<std::string> missing;
  for (const Gradient& gradient : result.gradients) {
    if (gradient.measures.array().isNaN().all()) {
      missing.emplace_back(gradient.key);
      continue;
    }
    for (Eigen::Index i = 0; i < gradient.measures.size(); ++i)
      if (std::isnan(gradient.measures(i)) && std::isfinite(state_measures[i].value(result.state)))
        missing.push_back(fmt::format("{} (of {})", gradient.key, state_measures[i].name));
  }
  if (missing.empty()) return {};
  return fmt::format("There are no derivatives by {}: the equations are not smooth in it at this state.",
                     fmt::join(missing, ", "));
}

Result solve_with_gradients(const Case& c, std::span<const std::string_view> keys, const SolveWithLines& solve) {
  Result result{c, scales_of(c), problem_of(c), {}};
  std::vector<std::vector<CasePoint>> cases;
  std::vector<ProblemLine> lines;
  for (const std::string_view key : keys) {
    ProblemLine& line = lines.emplace_back();
    for (const CasePoint& point : cases.emplace_back(case_line(c, key)))
      line.push_back({point.change, point.weight, problem_of(point.input)});
  }
  result.state = solve(result.problem, lines);
  for (std::size_t i = 0; i < keys.size(); ++i)
    result.gradients.push_back(gradient_along(keys[i], cases[i], result, lines[i]));
  refuse_unfinite_numbers(result);
  if (const std::string missing = missing_gradients(result); !missing.empty())
    result.state.outcome.message += " " + missing;
  return result;
}

}  // namespace rheocyte

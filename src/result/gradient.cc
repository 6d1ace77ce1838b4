#include "result/gradient.h"

#include <utility>
#include <vector>

#include "case/case_line.h"
#include "case/scales.h"

namespace rheocyte {
namespace {

/// Weighted sums of the numbers along a line, in physical units.
Gradient gradient_along(std::string_view key, const std::vector<CasePoint>& cases, const ProblemLine& line) {
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
  return gradient;
}

}  // namespace

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
  for (std::size_t i = 0; i < keys.size(); ++i) result.gradients.push_back(gradient_along(keys[i], cases[i], lines[i]));
  refuse_unfinite_numbers(result);
  return result;
}

}  // namespace rheocyte

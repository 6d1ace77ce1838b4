#include "solve/sensitivity.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "solve/warm_start.h"

namespace rheocyte {
namespace {

/// Of the changes' linear systems, relative to their right-hand sides.
constexpr double wanted_residual = 1e-6;
constexpr int max_refinements = 3;
/// Greatest change of an unknown for these systems. With smaller ones rounding shows in the forces of bending, with
/// larger ones that they are not linear.
constexpr double small_change = 2e-4;

/// Then systems differ in the media that they are given alone.
bool have_same_mesh_and_inflow(const Problem& a, const Problem& b) {
  Liquid liquid = a.liquid;
  liquid.reynolds = b.liquid.reynolds;  // has no effect on developed flow
  return has_same_channel(a, b) && has_same_mesh(a, b) && liquid == b.liquid;
}

/// Of another problem, in which the unknowns mean the same.
std::shared_ptr<Discrete> made_like(const Discrete& discrete, const Geometry& geometry, const Problem& problem) {
  auto made = geometry.make(problem, discrete.resolution());
  if (auto fitted = made->fitted_as(discrete)) return fitted;
  return made;
}

/// A problem's equations in the unknowns of a state.
class Equations {
 public:
  Equations(const Geometry& geometry, const Problem& base, const ResolvedState& state, const Problem& problem)
      : media_(problem),
        discrete_(have_same_mesh_and_inflow(base, problem) ? state.discrete
                                                           : made_like(*state.discrete, geometry, problem)) {}

  VectorXd residual(const VectorXd& unknowns) const { return discrete_->system().residual(media_, unknowns).value; }
  Discrete& discrete() const { return *discrete_; }
  const Media& media() const { return media_; }

 private:
  Media media_;
  std::shared_ptr<Discrete> discrete_;
};

MatrixXd columns_of(const MatrixXd& matrix, const std::vector<int>& chosen) { return matrix(Eigen::all, chosen); }

std::vector<int> columns_that_are_not_zero(const MatrixXd& matrix) {
  std::vector<int> chosen;
  for (int j = 0; j < matrix.cols(); ++j)
    if ((matrix.col(j).array() != 0).any()) chosen.push_back(j);
  return chosen;
}

/// A sum of columns in which none hides what another one lacks.
VectorXd sum_of_columns(const MatrixXd& matrix) {
  VectorXd weights(matrix.cols());
  for (int j = 0; j < weights.size(); ++j) weights(j) = 1.5 + std::cos(j);
  return matrix * weights;
}

/// K V, by central differences of the residual.
MatrixXd tangent_times(const Equations& equations, const VectorXd& unknowns, const MatrixXd& V) {
  MatrixXd product(V.rows(), V.cols());
  for (int j = 0; j < V.cols(); ++j) {
    const double step = small_change / V.col(j).lpNorm<Eigen::Infinity>();
    const VectorXd change = step * V.col(j);
    product.col(j) = (equations.residual(unknowns + change) - equations.residual(unknowns - change)) / (2 * step);
  }
  return product;
}

/// Columns that are not solved are no numbers.
void keep_solved(const MatrixXd& rest, MatrixXd& V) {
  for (int j = 0; j < V.cols(); ++j)
    if (!(rest.col(j).norm() < wanted_residual)) V.col(j).setConstant(no_value);
}

/// K V = rhs, of columns of length 1, with the factors of this very state: those at hand are of a state nearby, and
/// would take more substitutions than new ones cost. Bending leaves them a few digits. Each column for itself: where
/// the equations are not linear over the smallest change that rounding allows, it is no number.
MatrixXd refined_solution(const Equations& equations, const VectorXd& unknowns, const MatrixXd& rhs) {
  NonlinearSystem& system = equations.discrete().system();
  system.linearise(equations.media(), unknowns);
  if (!system.has_factors()) return MatrixXd::Constant(rhs.rows(), rhs.cols(), no_value);
  MatrixXd V = system.solve_columns(rhs);
  const VectorXd wanted = sum_of_columns(rhs);
  for (int refinements = 0;; ++refinements) {
    if ((wanted - tangent_times(equations, unknowns, sum_of_columns(V))).norm() < wanted_residual) return V;
    const MatrixXd rest = rhs - tangent_times(equations, unknowns, V);
    if (refinements == max_refinements) return keep_solved(rest, V), V;
    V += system.solve_columns(rest);
  }
}

/// The same of any columns.
MatrixXd solved_tangent(const Equations& equations, const VectorXd& unknowns, const MatrixXd& rhs) {
  const std::vector<int> some = columns_that_are_not_zero(rhs);  // what has no effect at all changes nothing
  MatrixXd V = MatrixXd::Zero(rhs.rows(), rhs.cols());
  if (some.empty()) return V;
  const MatrixXd chosen = columns_of(rhs, some);
  const VectorXd norms = chosen.colwise().norm();
  V(Eigen::all, some) =
      refined_solution(equations, unknowns, chosen * norms.cwiseInverse().asDiagonal()) * norms.asDiagonal();
  return V;
}

bool have_alike_unknowns(const Geometry& geometry, const Problem& base, const ResolvedState& state,
                         const ProblemLine& line) {
  return std::ranges::all_of(line, [&](const LinePoint& point) {
    return has_same_laws(base, point.problem) && geometry.is_alike(base, point.problem, state.discrete->resolution());
  });
}

}  // namespace

void follow_lines(const Geometry& geometry, const Problem& base, ResolvedState& state, std::span<ProblemLine> lines) {
  const VectorXd& unknowns = state.branch.unknowns;
  MatrixXd rhs = MatrixXd::Zero(unknowns.size(), std::ssize(lines));
  std::vector<std::vector<Equations>> equations(lines.size());
  for (std::size_t j = 0; j < lines.size(); ++j) {
    if (!have_alike_unknowns(geometry, base, state, lines[j])) lines[j].clear();
    for (const LinePoint& point : lines[j]) {
      const Equations& here = equations[j].emplace_back(geometry, base, state, point.problem);
      rhs.col(Eigen::Index(j)) -= point.weight * here.residual(unknowns);
    }
  }
  const MatrixXd slopes = solved_tangent({geometry, base, state, base}, unknowns, rhs);
  for (std::size_t j = 0; j < lines.size(); ++j) {
    const auto slope = slopes.col(Eigen::Index(j));
    if (!slope.allFinite()) lines[j].clear();
    for (std::size_t i = 0; i < lines[j].size(); ++i) {
      LinePoint& point = lines[j][i];
      equations[j][i].discrete().describe(point.problem, unknowns + point.change * slope, point.state);
    }
  }
}

}  // namespace rheocyte

#include "solve/sensitivity.h"

#include <Eigen/QR>
#include <algorithm>
#include <memory>
#include <optional>

#include "solve/warm_start.h"

namespace rheocyte {
namespace {

/// Of the changes' linear systems, relative to their right-hand sides.
constexpr double wanted_residual = 1e-7;
constexpr int max_passes = 8;
/// Greatest change of an unknown for these systems: with smaller ones rounding tells, with larger ones bending is far
/// from linear.
constexpr double small_change = 2e-6;

/// Then systems differ in the media that they are given alone.
bool have_same_mesh_and_inflow(const Problem& a, const Problem& b) {
  Liquid liquid = a.liquid;
  liquid.reynolds = b.liquid.reynolds;  // has no effect on developed flow
  return has_same_channel(a, b) && has_same_mesh(a, b) && liquid == b.liquid;
}

/// A problem's equations in the unknowns of a state.
class Equations {
 public:
  Equations(const Geometry& geometry, const Problem& base, const ResolvedState& state, const Problem& problem)
      : media_(problem),
        discrete_(have_same_mesh_and_inflow(base, problem) ? state.discrete
                                                           : geometry.make(problem, state.discrete->resolution())) {}

  VectorXd residual(const VectorXd& unknowns) const { return discrete_->system().residual(media_, unknowns).value; }
  Discrete& discrete() const { return *discrete_; }
  const Media& media() const { return media_; }

 private:
  Media media_;
  std::shared_ptr<Discrete> discrete_;
};

MatrixXd columns_of(const MatrixXd& matrix, const std::vector<int>& chosen) { return matrix(Eigen::all, chosen); }

std::vector<int> columns_longer_than(double length, const MatrixXd& matrix) {
  std::vector<int> chosen;
  for (int j = 0; j < matrix.cols(); ++j)
    if (matrix.col(j).norm() > length) chosen.push_back(j);
  return chosen;
}

void append(const MatrixXd& more, MatrixXd& matrix) {
  matrix.conservativeResize(more.rows(), matrix.cols() + more.cols());
  matrix.rightCols(more.cols()) = more;
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

/// K V = rhs, of columns of length 1. The factors are those of a state nearby, and of a few digits; so each pass adds
/// directions that they give, of which the combinations with the least residuals are taken, all columns together.
/// Nothing where that does not lead to the solution.
std::optional<MatrixXd> combined_solution(const Equations& equations, const VectorXd& unknowns, const MatrixXd& rhs) {
  NonlinearSystem& system = equations.discrete().system();
  MatrixXd directions(rhs.rows(), 0), images(rhs.rows(), 0), left = rhs;
  for (int pass = 0; pass < max_passes; ++pass) {
    const MatrixXd more = system.solve_columns(columns_of(left, columns_longer_than(wanted_residual, left)));
    if (!more.allFinite() || (more.array() == 0).colwise().all().any()) return std::nullopt;
    append(more, directions);
    append(tangent_times(equations, unknowns, more), images);
    if (!images.allFinite()) return std::nullopt;
    const MatrixXd shares = images.householderQr().solve(rhs);
    left = rhs - images * shares;
    if (columns_longer_than(wanted_residual, left).empty()) return directions * shares;
  }
  return std::nullopt;
}

/// The same of any columns, with factors of this very state where those at hand do not do.
std::optional<MatrixXd> solved_tangent(const Equations& equations, const VectorXd& unknowns, const MatrixXd& rhs) {
  const Eigen::RowVectorXd sizes = rhs.colwise().norm();
  const std::vector<int> some = columns_longer_than(0, rhs);  // what has no effect at all changes nothing
  MatrixXd V = MatrixXd::Zero(rhs.rows(), rhs.cols());
  if (some.empty()) return V;
  const MatrixXd unit = columns_of(rhs, some).colwise().normalized();
  NonlinearSystem& system = equations.discrete().system();
  auto solution = system.has_factors() ? combined_solution(equations, unknowns, unit) : std::nullopt;
  if (!solution) {
    system.linearise(equations.media(), unknowns);
    if (system.has_factors()) solution = combined_solution(equations, unknowns, unit);
  }
  if (!solution) return std::nullopt;
  for (std::size_t j = 0; j < some.size(); ++j) V.col(some[j]) = sizes(some[j]) * solution->col(Eigen::Index(j));
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
  const auto slopes = solved_tangent({geometry, base, state, base}, unknowns, rhs);
  for (std::size_t j = 0; j < lines.size(); ++j) {
    if (!slopes) lines[j].clear();
    for (std::size_t i = 0; i < lines[j].size(); ++i) {
      LinePoint& point = lines[j][i];
      equations[j][i].discrete().describe(point.problem, unknowns + point.change * slopes->col(Eigen::Index(j)),
                                          point.state);
    }
  }
}

}  // namespace rheocyte

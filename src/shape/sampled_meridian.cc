#include "shape/sampled_meridian.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "shape/cross.h"
#include "shape/curve.h"

namespace rheocyte {
namespace {

// Gaps, poles off the axis and negative radii below this fraction of the size are rounding of a solver or a file.
constexpr double relative_gap = 1e-8;

bool has_readable_pieces(const Contour& contour) {
  if (contour.pieces.empty()) return false;
  return std::all_of(contour.pieces.begin(), contour.pieces.end(), [](const CurvePiece& piece) {
    return degree_of(piece) >= 1 && degree_of(piece) <= max_curve_degree && piece.allFinite();
  });
}

bool is_continuous(const std::vector<CurvePiece>& pieces, double max_gap) {
  for (std::size_t i = 1; i < pieces.size(); ++i) {
    const auto& previous = pieces[i - 1];
    if ((previous.row(previous.rows() - 1) - pieces[i].row(0)).norm() > max_gap) return false;
  }
  return true;
}

bool segments_cross(const Eigen::MatrixX2d& points, int i, int j) {
  const Eigen::Vector2d a = points.row(i), b = points.row(i + 1), c = points.row(j), d = points.row(j + 1);
  return cross(b - a, c - a) * cross(b - a, d - a) < 0 && cross(d - c, a - c) * cross(d - c, b - c) < 0;
}

// Sweep along x: only segments whose x-intervals overlap are compared.
bool crosses_itself(const Eigen::MatrixX2d& points) {
  const int segments = static_cast<int>(points.rows()) - 1;
  const auto left = [&](int i) { return std::min(points(i, 0), points(i + 1, 0)); };
  const auto right = [&](int i) { return std::max(points(i, 0), points(i + 1, 0)); };
  std::vector<int> order(segments);
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](int i, int j) { return left(i) < left(j); });
  for (int i = 0; i < segments; ++i)
    for (int j = i + 1; j < segments && left(order[j]) <= right(order[i]); ++j)
      if (segments_cross(points, order[i], order[j])) return true;
  return false;
}

Eigen::MatrixX2d sample(const std::vector<CurvePiece>& pieces) {
  constexpr int n = SampledMeridian::samples_per_piece;
  const Eigen::VectorXd parameters = Eigen::VectorXd::LinSpaced(n + 1, 0, 1);
  Eigen::MatrixX2d points(static_cast<Eigen::Index>(pieces.size()) * n + 1, 2);
  Eigen::MatrixXd basis;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    if (basis.cols() != pieces[i].rows()) basis = lagrange_basis(degree_of(pieces[i]), parameters);
    points.middleRows(static_cast<Eigen::Index>(i) * n, n + 1) = basis * pieces[i];
  }
  return points;
}

}  // namespace

std::optional<SampledMeridian> SampledMeridian::of(const Contour& contour) {
  if (!has_readable_pieces(contour)) return std::nullopt;
  SampledMeridian meridian;
  meridian.pieces_ = contour.pieces;
  meridian.points_ = sample(contour.pieces);
  const auto& x = meridian.points_.col(0);
  meridian.size_ = std::max(x.maxCoeff() - x.minCoeff(), meridian.points_.col(1).maxCoeff());
  if (!meridian.has_inside()) return std::nullopt;
  return meridian;
}

bool SampledMeridian::has_inside() const {
  const double gap = relative_gap * size_;
  const int last = last_sample();
  if (!(size_ > 0) || !std::isfinite(size_) || !is_continuous(pieces_, gap)) return false;
  if (std::abs(points_(0, 1)) > gap || std::abs(points_(last, 1)) > gap) return false;
  if (points_.col(1).minCoeff() < -gap || points_(0, 0) <= points_(last, 0)) return false;
  return !crosses_itself(points_);
}

Eigen::Vector2d SampledMeridian::point(double s) const {
  const int last_piece = static_cast<int>(pieces_.size()) - 1;
  const int piece = std::clamp(static_cast<int>(s), 0, last_piece);
  return evaluate(pieces_[piece], s - piece);
}

}  // namespace rheocyte

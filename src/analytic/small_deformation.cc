#include "analytic/small_deformation.h"

#include <cmath>
#include <numbers>

#include "case/scales.h"
#include "shape/curve.h"

namespace rheocyte {
namespace {

using std::numbers::pi;

// Velocity on the axis of a square duct of width L, in Q / L^2 (eq:peak-velocity). The series of the duct
// gives 2.0962560; the published tables were made with this rounded value, and are met with it.
constexpr double square_duct_peak = 2.0963;

// P_l(cos theta) and its derivatives with respect to cos theta for l = 0, 1, 2, ..., by recurrence.
class Legendre {
 public:
  explicit Legendre(double x) : x_(x), next_(x) {}

  double value() const { return value_; }
  double slope() const { return slope_; }  ///< dP_l/dx

  void advance() {
    ++l_;
    const double after = ((2 * l_ + 1) * x_ * next_ - l_ * value_) / (l_ + 1);
    const double slope_after = slope_before_ + (2 * l_ - 1) * value_;
    slope_before_ = slope_;
    slope_ = slope_after;
    value_ = next_;
    next_ = after;
  }

 private:
  int l_ = 0;
  double x_, value_ = 1, next_, slope_ = 0, slope_before_ = 0;
};

// (u_r, u_theta)
Eigen::Vector2d field_at(const SurfaceModes& modes, double theta) {
  Legendre P(std::cos(theta));
  Eigen::Vector2d field = Eigen::Vector2d::Zero();
  for (int j = 0; j < modes.size(); ++j) {
    P.advance();
    field.x() += modes.normal(j) * P.value();
    field.y() -= modes.tangential(j) * std::sin(theta) * P.slope();
    P.advance();
  }
  return field;
}

// Coefficients of cos(m theta), m = 1, 3, 5, ..., of sum_l w_l P_l(cos theta).
Eigen::ArrayXd cosine_coefficients(const Eigen::ArrayXd& w) {
  const Eigen::Index size = w.size();
  Eigen::ArrayXd g(2 * size);  // (2 k)! / (4^k k!^2), coefficients of 1 / sqrt(1 - z)
  g(0) = 1;
  for (Eigen::Index k = 1; k < g.size(); ++k) g(k) = g(k - 1) * (2 * k - 1) / (2 * k);
  Eigen::ArrayXd a = Eigen::ArrayXd::Zero(size);
  for (Eigen::Index j = 0; j < size; ++j)          // l = 2 j + 1
    for (Eigen::Index i = 0; i <= j; ++i)          // m = 2 i + 1
      a(i) += w(j) * 2 * g(j - i) * g(j + i + 1);  // both terms exp(+-i m theta) of the generating function
  return a;
}

}  // namespace

double peak_velocity(Duct duct) {
  const double R = tube_radius_per_channel_width;
  return duct == Duct::tube ? 2 / pi : square_duct_peak * R * R;
}

CellInTube solid_in_tube(double lambda) {
  CellInTube cell{sphere_in_tube(lambda), {}};
  cell.displacement = solid_response(cell.sphere.traction);
  return cell;
}

CellInTube shell_in_tube(double lambda, double tension_ratio) {
  CellInTube cell{sphere_in_tube(lambda), {}};
  cell.displacement = shell_response(cell.sphere.traction, tension_ratio);
  return cell;
}

double solid_strain(double capillary_number, Duct duct) { return 3 * peak_velocity(duct) * capillary_number; }

double shell_strain(double capillary_number, double lambda, Duct duct) {
  return peak_velocity(duct) * capillary_number * lambda;
}

Eigen::MatrixX2d surface_points(const CellInTube& cell, double strain, const Eigen::ArrayXd& angles) {
  Eigen::MatrixX2d points(angles.size(), 2);
  for (Eigen::Index i = 0; i < angles.size(); ++i) {
    const double c = std::cos(angles(i)), s = std::sin(angles(i));
    const Eigen::Vector2d u = strain * field_at(cell.displacement, angles(i));
    points.row(i) << (1 + u.x()) * c - u.y() * s, (1 + u.x()) * s + u.y() * c;
  }
  return cell.sphere.lambda * points;
}

Contour contour(const CellInTube& cell, double strain) {
  constexpr int degree = max_curve_degree;
  // At least 2 nodes per half wave of the highest mode, which is 1e-10 of the lowest.
  const int pieces = 10 + cell.displacement.size() / 4;
  Contour meridian;
  for (int i = 0; i < pieces; ++i)
    meridian.pieces.push_back(surface_points(cell, strain, pi / pieces * (i + lobatto_nodes(degree).array())));
  meridian.pieces.front()(0, 1) = 0;  // sin(pi) is not zero in floating point
  meridian.pieces.back()(degree, 1) = 0;
  return meridian;
}

double leading_deformation(const CellInTube& cell) {
  const Eigen::ArrayXd a = cosine_coefficients(cell.displacement.normal);
  double sum = 0;
  for (Eigen::Index i = 1; i < a.size(); ++i) sum += ((2 * i + 1) * (2 * i + 1) - 1) * a(i) * a(i);
  return sum / 4;
}

SmallDeformation small_deformation(const CellInTube& cell, double strain) {
  SmallDeformation state{contour(cell, strain), {}};
  state.shape = measure(state.contour);
  return state;
}

}  // namespace rheocyte

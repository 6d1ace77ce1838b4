#include "analytic/wall_reflection.h"

#include <cassert>
#include <cmath>
#include <numbers>

#include "numeric/special_functions.h"

namespace rheocyte {
namespace {

using std::numbers::pi;

// k = exp(t - exp(-t)) makes the integrands fall doubly exponentially at both ends; the trapezoidal rule then gains
// digits exponentially in 1/step. The ends give k = 2e-17 and k = 335, where exp(2 k) is still a double.
constexpr double step = 1.0 / 32, first_t = -3.55, last_t = 5.82;

// I_1^2 - I_0 I_2 as a series of positive terms: the difference of the products would cancel for small k.
double delta(double k) {
  double term = k * k / 8, sum = term;
  for (int j = 0; term > 1e-17 * sum; ++j) {
    term *= k * k / 4 * 2 * (2 * j + 3) / ((j + 1.0) * (j + 3.0) * (j + 3.0));
    sum += term;
  }
  return sum;
}

// W and 2 W - 1; the Wronskian I_0 K_1 + I_1 K_0 = 1/k spares the second one the cancellation for small k.
struct WallFactor {
  double W, twice_minus_one;
};

WallFactor wall_factor(double k) {
  const double I1 = scaled_bessel_i(1, k), I2 = scaled_bessel_i(2, k);
  const double K0 = scaled_bessel_k(0, k), K1 = scaled_bessel_k(1, k);
  return {I1 * K1 + I2 * K0, -k * I2 * K1 + K0 * (2 * I2 - k * I1)};
}

int sign(int function) { return function % 2 == 0 ? 1 : -1; }  // (-1)^((n - 2) / 2)

// The entry (m, n) of the four matrices.
class ReflectionEntry {
 public:
  ReflectionEntry(const WallMoments& moments, int row, int column)
      : moments_(moments), m_(2 * (row + 1)), n_(2 * (column + 1)), sign_(sign(row) * sign(column)) {}

  double CA() const { return c2_times(q() - 4) - V(q() - 2); }
  double DA() const { return M(q() - 2) / (2 * m_ + 1); }
  double CB() const {
    if (q() == 4) return moments_.lambda_0 / pi;
    const double first = m_ * (m_ - 1.0) / (2 * m_ - 3) * V(q() - 4) - M(q() - 4);
    return (2 * n_ - 3) * first - (n_ == 2 ? 0 : (n_ - 2) * (n_ - 3) * (c2_times(q() - 6) - V(q() - 4)));
  }
  double DB() const {
    return ((2 * n_ - 3) * V(q() - 2) - (n_ == 2 ? 0 : (n_ - 2) * (n_ - 3) * M(q() - 4))) / (2 * m_ + 1);
  }

 private:
  int q() const { return n_ + m_; }

  // s_mn c_p; the factorials overflow, their quotient does not.
  double weight(int p) const {
    return 4 * sign_ *
           std::exp(std::lgamma(p + 3) - (p + 3) * std::numbers::ln2 - std::lgamma(n_ + 1) - std::lgamma(m_ - 1));
  }
  double M(int p) const { return weight(p) * moments_.m(p / 2 - 1); }
  double V(int p) const { return weight(p) * moments_.v(p / 2 - 1); }

  // The integral that belongs to a vanishing factor does not exist.
  double c2_times(int p) const { return m_ == 2 ? 0 : (m_ - 2) * (m_ - 3.0) / (2 * m_ - 3) * M(p); }

  const WallMoments& moments_;
  int m_, n_, sign_;
};

}  // namespace

WallMoments wall_moments(int max_p) {
  assert(max_p >= 2 && max_p <= 400 && max_p % 2 == 0);
  WallMoments moments{Eigen::ArrayXd::Zero(max_p / 2), Eigen::ArrayXd::Zero(max_p / 2), 0};
  const int nodes = static_cast<int>((last_t - first_t) / step) + 1;
  for (int i = 0; i < nodes; ++i) {
    const double t = first_t + i * step, k = std::exp(t - std::exp(-t));
    const double weight = step * k * (1 + std::exp(-t)) / delta(k);
    const auto [W, twice_minus_one] = wall_factor(k);
    moments.lambda_0 += weight * twice_minus_one;
    double scaled = weight * k * k * 32 / 24 / (2 * pi);  // weight k^p / c_p at p = 2
    for (int p = 2; p <= max_p; p += 2) {
      moments.m(p / 2 - 1) += scaled;
      moments.v(p / 2 - 1) += scaled * W;
      scaled *= 4 * k * k / ((p + 3.0) * (p + 4.0));
    }
  }
  return moments;
}

WallReflection wall_reflection(int functions) {
  assert(functions >= 1 && functions <= 100);
  const WallMoments moments = wall_moments(4 * functions);
  const Eigen::ArrayXXd empty(functions, functions);
  WallReflection reflection{empty, empty, empty, empty};
  for (int row = 0; row < functions; ++row)
    for (int column = 0; column < functions; ++column) {
      const ReflectionEntry entry(moments, row, column);
      reflection.CA(row, column) = entry.CA();
      reflection.CB(row, column) = entry.CB();
      reflection.DA(row, column) = entry.DA();
      reflection.DB(row, column) = entry.DB();
    }
  return reflection;
}

}  // namespace rheocyte

// Chord steps that learn from those before them (solve/chord_mixing.h).
#include "solve/chord_mixing.h"

#include <gtest/gtest.h>

#include <cmath>

#include "solve/newton.h"

namespace rheocyte::chord_mixing_test {
namespace {

using Eigen::MatrixXd;

/// Equations A x + c |x|^2 = b whose kept factors are those of the diagonal alone.
class Kept final : public NonlinearSystem {
 public:
  explicit Kept(double curvature) : curvature_(curvature) {
    for (int i = 0; i < size; ++i)
      for (int j = 0; j < size; ++j) A_(i, j) = i == j ? 2 + i : 0.8 / (1 + i + 2 * j);
    has_factors_ = true;
  }

  VectorXd sphere() const override { return VectorXd::Zero(size); }
  Residual residual(const Media&, const VectorXd& x) override {
    return {A_ * x - VectorXd::LinSpaced(size, 1, 2) + curvature_ * VectorXd::Constant(size, x.squaredNorm()), 1};
  }
  Residual linearise(const Media& media, const VectorXd& x) override {
    ++work_.factorisations;
    return residual(media, x);
  }
  VectorXd solve(const VectorXd& rhs) override { return rhs.cwiseQuotient(A_.diagonal()); }
  MatrixXd solve_columns(const MatrixXd& rhs) override { return A_.diagonal().cwiseInverse().asDiagonal() * rhs; }

  double cell_radius() const override { return 1; }
  double largest_displacement(const VectorXd& x) const override { return x.cwiseAbs().maxCoeff(); }
  void scale_displacement(double factor, VectorXd& x) const override { x *= factor; }
  double stretch_change(const VectorXd&, const VectorXd&) const override { return 0; }
  std::size_t memory_bytes() const override { return 0; }
  void drop_factors() override { has_factors_ = false; }

  static constexpr int size = 5;

 private:
  double curvature_;
  MatrixXd A_ = MatrixXd(size, size);
};

NewtonOptions kept_factors(int chord_limit) {
  return {.tolerance = 1e-12, .keep_factors = true, .chord_limit = chord_limit, .residual_scale = 1};
}

TEST(ChordMixing, SolvesLinearEquationsInAsManyStepsAsThereAreUnknowns) {
  // As GMRES does; the last residual is rounding. Plain chord steps with the same factors take more.
  Kept system(0);
  VectorXd x = system.sphere();
  ChordMixing mixing(mixed_chord_steps);
  for (int k = 0; k <= Kept::size; ++k) x += mixing.correction(system, x, system.residual({}, x).value);
  EXPECT_LT(system.residual({}, x).value.norm(), 1e-12);
  VectorXd plain = system.sphere();
  for (int k = 0; k <= Kept::size; ++k) plain += system.solve(-system.residual({}, plain).value);
  EXPECT_GT(system.residual({}, plain).value.norm(), 1e-4);
}

TEST(ChordMixing, WithoutStepsToLearnFromAStepIsAPlainOne) {
  // The first one, and that after new factors.
  Kept system(0.1);
  const VectorXd x = VectorXd::LinSpaced(Kept::size, -1, 1), r = system.residual({}, x).value;
  ChordMixing mixing(mixed_chord_steps);
  const VectorXd plain = system.solve(-r);
  EXPECT_EQ(mixing.correction(system, x, r), plain);
  mixing.correction(system, x + plain, system.residual({}, x + plain).value);
  mixing.forget();
  EXPECT_EQ(mixing.correction(system, x, r), plain);
}

TEST(ChordMixing, InNewtonsMethodItReachesTheSameSolutionWithoutNewFactors) {
  // Of equations that are not linear, within the tolerance; the plain method asks for factors again and again.
  Kept learning(0.05), plain(0.05);
  VectorXd x = learning.sphere(), y = x;
  NewtonOptions options = kept_factors(0);
  options.iteration_limit = 100;
  ASSERT_EQ(newton(learning, {}, kept_factors(40), x).status, Status::converged);
  ASSERT_EQ(newton(plain, {}, options, y).status, Status::converged);
  EXPECT_LT((x - y).norm(), 1e-11);
  EXPECT_EQ(learning.work().factorisations, 0);
  EXPECT_GT(plain.work().factorisations, 0);
}

}  // namespace
}  // namespace rheocyte::chord_mixing_test

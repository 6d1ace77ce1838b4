// The limit of short wrinkles against the waves themselves: the second variation of the energy of a half-space.
#include "laws/short_waves.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <numbers>

#include "random_states.h"

namespace rheocyte::short_waves_test {
namespace {

using Eigen::MatrixXd;
using Matrix9 = Eigen::Matrix<double, 9, 9>;

constexpr double mu = 1.7;

Bulk fung(double stiffening) { return {.law = BulkLaw::fung, .shear_modulus = mu, .stiffening = stiffening}; }

/// Nominal stress of a small further deformation I + H of a half-space without stress on its surface (axis 2), by H.
/// The pressure is such that there is none; its change does no work.
Matrix9 incremental_moduli(const Bulk& bulk, const Tensor<double>& F) {
  std::array<double, 9> none{};
  Tensor<Dual<double, 9>> moved{independent(none)};
  for (int i = 0; i < 3; ++i) moved(i, i).value = 1;
  const Tensor<Dual<double, 9>> extra = elastic_stress(bulk, moved * F.cast<Dual<double, 9>>());
  Matrix9 moduli;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      for (int k = 0; k < 3; ++k)
        for (int l = 0; l < 3; ++l) {
          const double pressure = i == l ? extra(2, 2).value : 0, stress = extra(i, l).value - pressure;
          moduli(i + 3 * j, k + 3 * l) = extra(i, j).slope(k + 3 * l) - (j == k ? stress : 0);
        }
  return moduli;
}

constexpr int functions = 20;

/// Laguerre's functions of the depth and two derivatives, weighted by the root of the quadrature's weight. The depth is
/// the square of the variable that goes in equal steps: the functions oscillate evenly in it.
struct Depths {
  MatrixXd value, slope, second;

  explicit Depths(double decay) {
    constexpr int points = 1400;  // even
    constexpr double step = 0.01;
    for (MatrixXd* m : {&value, &slope, &second}) m->resize(points + 1, functions);
    for (int q = 0; q <= points; ++q) {
      const double u = q * step, simpson = q == 0 || q == points ? 1 : q % 2 ? 4 : 2;
      fill(q, u * u / decay, decay, std::sqrt(simpson * step / 3 * 2 * u / decay));
    }
  }

 private:
  void fill(int q, double depth, double decay, double weight) {
    using First = Dual<double, 1>;
    using Second = Dual<First, 1>;
    const Second t = Second(First(depth, 0), 0) * constant<First>(decay);
    Second before = constant<Second>(0), now = exp(t * constant<First>(-0.5));
    for (int i = 0; i < functions; ++i) {
      value(q, i) = weight * now.value.value;
      slope(q, i) = weight * now.value.slope(0);
      second(q, i) = weight * now.slope(0).slope(0);
      const Second next =
          ((constant<Second>(2 * i + 1) - t) * now - before * constant<First>(i)) * constant<First>(1.0 / (i + 1));
      before = now;
      now = next;
    }
  }
};

/// Least energy, relative to that of the shear modulus, of a wave of length 2 pi along axis 0 with the displacements
/// (phi' sin x, chi sin x, -phi cos x), which keep the volume.
double least_energy(const Bulk& bulk, const Tensor<double>& F, double decay) {
  const Depths f(decay);
  const MatrixXd zero = MatrixXd::Zero(f.value.rows(), functions);
  struct Part {
    int gradient;  ///< i + 3 j of du_i/dx_j
    MatrixXd by_function;
  };
  const auto part = [](int i, int j, const MatrixXd& phi, const MatrixXd& chi) {
    MatrixXd both(phi.rows(), 2 * functions);
    both << phi, chi;
    return Part{i + 3 * j, both};
  };
  const std::array cosines{part(0, 0, f.slope, zero), part(2, 2, -f.slope, zero), part(1, 0, zero, f.value)};
  const std::array sines{part(0, 2, f.second, zero), part(2, 0, f.value, zero), part(1, 2, zero, f.slope)};
  const Matrix9 moduli = incremental_moduli(bulk, F);
  MatrixXd energy = MatrixXd::Zero(2 * functions, 2 * functions);
  for (const auto& parts : {cosines, sines})
    for (const Part& a : parts)
      for (const Part& b : parts) energy += moduli(a.gradient, b.gradient) * a.by_function.transpose() * b.by_function;
  const MatrixXd symmetric = (energy + energy.transpose()) / 2;
  return Eigen::SelfAdjointEigenSolver<MatrixXd>(symmetric, Eigen::EigenvaluesOnly).eigenvalues()(0) / mu;
}

/// The same in a half-space with this ratio of the stretch across to the normal one, and this stretch along; the wave
/// runs at an angle to the former direction.
double least_energy(const Bulk& bulk, double ratio, double along, double degrees = 0) {
  const double across = std::sqrt(ratio / along), angle = degrees * std::numbers::pi / 180;
  const Tensor<double> turn{std::cos(angle), std::sin(angle), 0, -std::sin(angle), std::cos(angle), 0, 0, 0, 1};
  const Tensor<double> stretch = test::diagonal(across, along, 1 / (across * along));
  return least_energy(bulk, turn * stretch * turn.transpose(), 2 * std::sqrt(ratio));
}

/// The waves are known to 1e-5 of the ratio.
void expect_limit(const Bulk& bulk, double along) {
  const double limit = wrinkling_limit(bulk, along);
  EXPECT_GT(least_energy(bulk, 1.001 * limit, along), 0) << along;
  EXPECT_LT(least_energy(bulk, 0.999 * limit, along), 0) << along;
}

TEST(ShortWaves, MooneyRivlinSolidsWrinkleAtBiotsRatio) {
  // Whatever the fraction and the stretch along the crests.
  for (const double along : {0.8, 1.0, 1.4})
    for (const Bulk& bulk :
         {Bulk{BulkLaw::neo_hookean, mu}, Bulk{BulkLaw::linear, mu}, Bulk{BulkLaw::mooney_rivlin, mu, 0.3}, fung(0)})
      expect_limit(bulk, along);
}

TEST(ShortWaves, FungSolidsWrinkleAtTheirLimit) {
  // The more they stiffen the later.
  for (const auto& [stiffening, along] : {std::pair{0.05, 1.0}, {0.2, 1.0}, {0.2, 1.4}, {0.3, 0.9}, {0.4, 1.6}})
    expect_limit(fung(stiffening), along);
  for (const double along : {0.8, 1.0, 1.4}) {
    double before = biot_limit;
    for (const double stiffening : {1e-9, 1e-3, 0.1, 0.2, 0.3, 0.39}) {
      const double limit = wrinkling_limit(fung(stiffening), along);
      EXPECT_LT(limit, before);
      before = limit;
    }
  }
}

TEST(ShortWaves, TheLimitSolvesItsEquation) {
  // x^3 + x^2 + 3 x - 1 + c (1 - x^2)^2 = 0 for all c below 1, and it ends at 0 there.
  for (int i = 0; i <= 1000; ++i) {
    const double c = i / 1000.0, x = wrinkling_limit(fung(c / 2), 1);
    EXPECT_NEAR(x * x * x + x * x + 3 * x - 1 + c * (1 - x * x) * (1 - x * x), 0, 1e-14);
    EXPECT_GE(x, 0);
  }
  EXPECT_NEAR(wrinkling_limit(fung(0.5 - 1e-9), 1), 0, 1e-8);
}

TEST(ShortWaves, FungSolidsThatStiffenEnoughNeverWrinkle) {
  // 2 b >= the stretch along the crests; in no direction.
  EXPECT_EQ(wrinkling_limit(fung(0.5), 1), 0);
  EXPECT_EQ(wrinkling_limit(fung(1), 1.9), 0);
  for (const double ratio : {0.05, 0.1, 0.2, 0.29})
    for (const double stiffening : {0.55, 1.0, 3.0})
      for (const double degrees : {0.0, 10.0, 30.0, 60.0})
        EXPECT_GT(least_energy(fung(stiffening), ratio, 1, degrees), 0) << stiffening << " at " << ratio;
}

TEST(ShortWaves, ObliqueWavesComeLater) {
  // Where waves across the least stretch are just stable, those at an angle are.
  for (const auto& [stiffening, along] : {std::pair{0.0, 1.0}, {0.2, 1.0}, {0.4, 1.4}, {0.3, 0.9}})
    for (const double degrees : {5.0, 15.0, 30.0, 45.0, 60.0, 80.0})
      EXPECT_GT(least_energy(fung(stiffening), 1.001 * wrinkling_limit(fung(stiffening), along), along, degrees), 0)
          << stiffening << " at " << degrees;
}

TEST(ShortWaves, TheMarginIsOneWithoutDeformationAndZeroAtTheLimit) {
  // Of Mooney-Rivlin solids the distance of the ratio from Biot's.
  for (const Bulk& bulk : {Bulk{BulkLaw::linear, mu}, fung(0.2), fung(3)}) {
    EXPECT_NEAR(wrinkling_margin(bulk, 1, 1), 1, 1e-14);
    const double along = 1.3, limit = wrinkling_limit(bulk, along);
    EXPECT_NEAR(wrinkling_margin(bulk, std::sqrt(limit / along), along), 0, 1e-14);
  }
  EXPECT_NEAR(wrinkling_margin({}, 0.7, 1.1), (0.7 * 0.7 * 1.1 - biot_limit) / (1 - biot_limit), 1e-14);
}

}  // namespace
}  // namespace rheocyte::short_waves_test

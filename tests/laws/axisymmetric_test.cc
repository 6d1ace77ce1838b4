#include "laws/axisymmetric.h"

#include <gtest/gtest.h>

#include "random_states.h"

namespace rheocyte::axisymmetric_test {
namespace {

using test::RandomStates;
using test::states;

// Some dozen operations on numbers of order one.
constexpr double rounding = 1e-13;
const Tensor<double> I = Tensor<double>::Identity();

TEST(Axisymmetric, AMapKnowsTheInverseOfItsMap) {
  // G^-1 G = I and the volume is r det G.
  RandomStates random;
  for (int i = 0; i < states; ++i) {
    const PointMap<double, 2> map = random.map();
    EXPECT_LT((map.inverse * map.G - Slopes<double, 2>::Identity()).norm(), rounding);
    EXPECT_NEAR(map.volume(), map.r * (map.G(0, 0) * map.G(1, 1) - map.G(0, 1) * map.G(1, 0)), rounding);
  }
}

TEST(Axisymmetric, ATranslationAlongTheAxisHasNoGradient) {
  // v = (c, 0): grad v = 0, hoop component included.
  RandomStates random;
  for (int i = 0; i < states; ++i) {
    EXPECT_EQ(
        gradient(random.map(), Components<double, 2>(3.7, 0), Slopes<double, 2>(Slopes<double, 2>::Zero())).norm(), 0);
  }
}

TEST(Axisymmetric, AUniformExpansionHasTheIdentityAsGradient) {
  // v = (x, r): grad v = I, whatever the element.
  RandomStates random;
  for (int i = 0; i < states; ++i) {
    const PointMap<double, 2> map = random.map();
    EXPECT_LT((gradient(map, Components<double, 2>(0.4, map.r), map.G) - I).norm(), rounding);
  }
}

TEST(Axisymmetric, AStretchingFlowIsFreeOfDivergence) {
  // v = (x, -r/2): grad v = diag(1, -1/2, -1/2).
  RandomStates random;
  for (int i = 0; i < states; ++i) {
    const PointMap<double, 2> map = random.map();
    const Slopes<double, 2> v_xi{map.G(0, 0), map.G(0, 1), -0.5 * map.G(1, 0), -0.5 * map.G(1, 1)};
    const Tensor<double> L = gradient(map, Components<double, 2>(0.4, -0.5 * map.r), v_xi);
    EXPECT_LT((L - test::diagonal(1, -0.5, -0.5)).norm(), rounding);
  }
}

TEST(Axisymmetric, TheUndeformedMapHasTheIdentityAsDeformationGradient) {
  // x = X gives F = I, x = 2 X gives F = 2 I.
  RandomStates random;
  for (int i = 0; i < states; ++i) {
    const PointMap<double, 2> map = random.map(), twice({2 * map.G, 2 * map.r});
    EXPECT_LT((deformation_gradient(map, map) - I).norm(), rounding);
    EXPECT_LT((deformation_gradient(twice, map) - 2 * I).norm(), rounding);
  }
}

TEST(Axisymmetric, DeformationGradientsFollowTheChainRule) {
  // F(a -> c) = F(b -> c) F(a -> b).
  RandomStates random;
  for (int i = 0; i < states; ++i) {
    const PointMap<double, 2> a = random.map(), b = random.map(), c = random.map();
    const Tensor<double> composed = deformation_gradient(c, b) * deformation_gradient(b, a);
    EXPECT_LT((deformation_gradient(c, a) - composed).norm(), 100 * rounding);  // entries up to 30
  }
}

TEST(Axisymmetric, TheDeterminantOfTheDeformationGradientIsTheRatioOfVolumes) {
  // det F = (r det G) / (R det G0).
  RandomStates random;
  for (int i = 0; i < states; ++i) {
    const PointMap<double, 2> now = random.map(), before = random.map();
    const double ratio = now.volume() / before.volume();
    EXPECT_NEAR(determinant(deformation_gradient(now, before)) / ratio, 1, rounding);
  }
}

TEST(Axisymmetric, ThePullBackGivesTheSameWorkAsTheTensors) {
  // value . phi + slope : d(phi)/d(xi) = (sigma : grad phi) r det G for symmetric stresses without torsion.
  RandomStates random;
  for (int i = 0; i < states; ++i) {
    const PointMap<double, 2> map = random.map();
    const Tensor<double> A = random.tensor(1);
    Tensor<double> sigma = A + A.transpose();
    sigma(0, 2) = sigma(2, 0) = sigma(1, 2) = sigma(2, 1) = 0;
    const Components<double, 2> phi(random.number(-1, 1), random.number(-1, 1));
    const Slopes<double, 2> phi_xi = random.element_map();
    const Flux<double, 2> flux = pull_back(map, sigma);
    const double direct = dot(sigma, gradient(map, phi, phi_xi)) * map.volume();
    EXPECT_NEAR(dot(flux.value, phi) + dot(flux.slope, phi_xi), direct, 10 * rounding);
  }
}

}  // namespace
}  // namespace rheocyte::axisymmetric_test

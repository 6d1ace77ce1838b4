#include "laws/axisymmetric.h"

#include <gtest/gtest.h>

#include "random_states.h"

namespace rheocyte {
namespace {

using test::RandomStates;
using test::states;

// Some dozen operations on numbers of order one.
constexpr double rounding = 1e-13;
const Tensor<double> I = Tensor<double>::Identity();

TEST(Axisymmetric, APlaceKnowsTheInverseOfItsMap) {
  // G^-1 G = I and the volume is r det G.
  RandomStates random;
  for (int i = 0; i < states; ++i) {
    const Place<double> place = random.place();
    EXPECT_LT((place.inverse * place.G - Plane<double>::Identity()).norm(), rounding);
    EXPECT_NEAR(place.volume(), place.r * (place.G(0, 0) * place.G(1, 1) - place.G(0, 1) * place.G(1, 0)), rounding);
  }
}

TEST(Axisymmetric, ATranslationAlongTheAxisHasNoGradient) {
  // v = (c, 0): grad v = 0, hoop component included.
  RandomStates random;
  for (int i = 0; i < states; ++i) {
    EXPECT_EQ(gradient(random.place(), PlaneVector<double>(3.7, 0), Plane<double>(Plane<double>::Zero())).norm(), 0);
  }
}

TEST(Axisymmetric, AUniformExpansionHasTheIdentityAsGradient) {
  // v = (x, r): grad v = I, whatever the element.
  RandomStates random;
  for (int i = 0; i < states; ++i) {
    const Place<double> place = random.place();
    EXPECT_LT((gradient(place, PlaneVector<double>(0.4, place.r), place.G) - I).norm(), rounding);
  }
}

TEST(Axisymmetric, AStretchingFlowIsFreeOfDivergence) {
  // v = (x, -r/2): grad v = diag(1, -1/2, -1/2).
  RandomStates random;
  for (int i = 0; i < states; ++i) {
    const Place<double> place = random.place();
    Plane<double> v_xi = place.G;
    v_xi.row(1) *= -0.5;
    const Tensor<double> L = gradient(place, PlaneVector<double>(0.4, -0.5 * place.r), v_xi);
    EXPECT_LT((L - Tensor<double>(Eigen::Vector3d(1, -0.5, -0.5).asDiagonal())).norm(), rounding);
  }
}

TEST(Axisymmetric, TheUndeformedPlaceHasTheIdentityAsDeformationGradient) {
  // x = X gives F = I, x = 2 X gives F = 2 I.
  RandomStates random;
  for (int i = 0; i < states; ++i) {
    const Place<double> place = random.place(), twice(2 * place.G, 2 * place.r);
    EXPECT_LT((deformation_gradient(place, place) - I).norm(), rounding);
    EXPECT_LT((deformation_gradient(twice, place) - 2 * I).norm(), rounding);
  }
}

TEST(Axisymmetric, DeformationGradientsFollowTheChainRule) {
  // F(a -> c) = F(b -> c) F(a -> b).
  RandomStates random;
  for (int i = 0; i < states; ++i) {
    const Place<double> a = random.place(), b = random.place(), c = random.place();
    const Tensor<double> composed = deformation_gradient(c, b) * deformation_gradient(b, a);
    EXPECT_LT((deformation_gradient(c, a) - composed).norm(), 100 * rounding);  // entries up to 30
  }
}

TEST(Axisymmetric, TheDeterminantOfTheDeformationGradientIsTheRatioOfVolumes) {
  // det F = (r det G) / (R det G0).
  RandomStates random;
  for (int i = 0; i < states; ++i) {
    const Place<double> now = random.place(), before = random.place();
    const double ratio = now.volume() / before.volume();
    EXPECT_NEAR(determinant(deformation_gradient(now, before)) / ratio, 1, rounding);
  }
}

TEST(Axisymmetric, ThePullBackGivesTheSameWorkAsTheTensors) {
  // value . phi + slope : d(phi)/d(xi) = (sigma : grad phi) r det G for symmetric stresses without torsion.
  RandomStates random;
  for (int i = 0; i < states; ++i) {
    const Place<double> place = random.place();
    const Tensor<double> A = random.tensor(1);
    Tensor<double> sigma = A + A.transpose();
    sigma(0, 2) = sigma(2, 0) = sigma(1, 2) = sigma(2, 1) = 0;
    const PlaneVector<double> phi(random.number(-1, 1), random.number(-1, 1));
    const Plane<double> phi_xi = random.element_map();
    const Flux<double> flux = pull_back(place, sigma);
    const double direct = sigma.cwiseProduct(gradient(place, phi, phi_xi)).sum() * place.volume();
    EXPECT_NEAR(flux.value.dot(phi) + flux.slope.cwiseProduct(phi_xi).sum(), direct, 10 * rounding);
  }
}

}  // namespace
}  // namespace rheocyte

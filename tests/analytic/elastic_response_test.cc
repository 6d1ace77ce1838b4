#include "analytic/elastic_response.h"

#include <gtest/gtest.h>

#include <cmath>

#include "analytic/sphere_in_tube.h"

namespace rheocyte::elastic_response_test {
namespace {

struct Mode {
  double normal, tangential;
};

void expect_modes(const SurfaceModes& found, const Mode (&expected)[8]) {
  for (int j = 0; j < 8; ++j) {  // printed with eleven digits; truncation of the traction at 1e-10 of its size
    EXPECT_NEAR(found.normal(j), expected[j].normal, 1e-10 * std::abs(expected[j].normal) + 1e-14) << 2 * j + 1;
    EXPECT_NEAR(found.tangential(j), expected[j].tangential, 1e-10 * std::abs(expected[j].tangential) + 1e-14);
  }
}

TEST(ElasticResponse, ASolidAtHalfTheTubesRadiusMovesAsTheReference) {
  // Displacement modes 1 to 15 per unit shear modulus.
  expect_modes(solid_response(sphere_in_tube(0.5).traction), {{0, -3.3494862746e-01},
                                                              {4.7746590536e-01, 1.5831507587e-01},
                                                              {-7.7915442225e-03, -1.4565787581e-03},
                                                              {1.0742543318e-03, 1.4357816055e-04},
                                                              {-1.2094238511e-04, -1.2569253348e-05},
                                                              {1.1897859157e-05, 1.0100345195e-06},
                                                              {-1.0623139974e-06, -7.6083306594e-08},
                                                              {8.8076340946e-08, 5.4437726759e-09}});
}

TEST(ElasticResponse, AShellAtHalfTheTubesRadiusMovesAsTheReference) {
  // Displacement modes 1 to 15 per r0 / E2D for the tension 0.1 E2D.
  expect_modes(shell_response(sphere_in_tube(0.5).traction, 0.1), {{0, -5.0242294118e-01},
                                                                   {1.5550091203e+00, 2.4396246954e-01},
                                                                   {-2.1731084120e-02, -1.3934646113e-03},
                                                                   {2.4621369927e-03, 8.9426374055e-05},
                                                                   {-2.3106432461e-04, -5.5360083894e-06},
                                                                   {1.9346281548e-05, 3.3466817319e-07},
                                                                   {-1.4981913496e-06, -1.9857366088e-08},
                                                                   {1.0945774674e-07, 1.1588429381e-09}});
}

TEST(ElasticResponse, InASmallTubeLimitTheThirdModeIsKnown) {
  // For lambda -> 0: solid w_3 = 7/8 lambda, v_3 = 7/24 lambda; shell without tension w_3 = 49/8 lambda. The traction's
  // next order is lambda^3 relative.
  const double lambda = 0.01, next_order = 5 * std::pow(lambda, 3);
  const SurfaceModes traction = sphere_in_tube(lambda).traction;
  const SurfaceModes solid = solid_response(traction);
  EXPECT_NEAR(solid.normal(1) / (7.0 / 8 * lambda), 1, next_order);
  EXPECT_NEAR(solid.tangential(1) / (7.0 / 24 * lambda), 1, next_order);
  EXPECT_NEAR(shell_response(traction, 0).normal(1) / (49.0 / 8 * lambda), 1, next_order);
}

TEST(ElasticResponse, AShellWithoutTensionHasAClosedForm) {
  // w_l = [(L - 1/2) N_l + 3/2 L T_l] / (L - 2), L = l (l + 1), by elimination of v_l.
  const SurfaceModes traction = sphere_in_tube(0.7).traction;
  const SurfaceModes shell = shell_response(traction, 0);
  for (int j = 1; j < traction.size(); ++j) {
    const double L = (2 * j + 1) * (2 * j + 2);
    const double expected = ((L - 0.5) * traction.normal(j) + 1.5 * L * traction.tangential(j)) / (L - 2);
    EXPECT_NEAR(shell.normal(j), expected, 1e-12 * shell.normal.abs().maxCoeff()) << j;
  }
}

TEST(ElasticResponse, TheDisplacementsOfTwoLoadsObeyReciprocity) {
  // Betti: the work of load a on the displacements of load b is that of b on a; for each mode
  // N_a w_b + L T_a v_b is symmetric. A test of the systems' coupling terms, solid and shell.
  const SurfaceModes a{Eigen::ArrayXd::LinSpaced(6, 0, 1), Eigen::ArrayXd::LinSpaced(6, 0, -0.3)};
  const SurfaceModes b{Eigen::ArrayXd::LinSpaced(6, 0, -2), Eigen::ArrayXd::LinSpaced(6, 0, 1.7)};
  const auto expect_symmetric = [&](const SurfaceModes& of_a, const SurfaceModes& of_b) {
    for (int j = 1; j < 6; ++j) {
      const double L = (2 * j + 1) * (2 * j + 2);
      const double ab = a.normal(j) * of_b.normal(j) + L * a.tangential(j) * of_b.tangential(j);
      const double ba = b.normal(j) * of_a.normal(j) + L * b.tangential(j) * of_a.tangential(j);
      EXPECT_NEAR(ab, ba, 1e-13 * (1 + std::abs(ab))) << j;  // 2x2 systems of condition up to a hundred
    }
  };
  expect_symmetric(solid_response(a), solid_response(b));
  expect_symmetric(shell_response(a, 0.1), shell_response(b, 0.1));
}

TEST(ElasticResponse, TensionStiffensAShell) {
  // Work of the load on its own displacement falls as the tension rises.
  const SurfaceModes traction = sphere_in_tube(0.6).traction;
  double previous = 1e9;
  for (const double tension : {0.0, 0.1, 1.0, 10.0}) {
    const double third = shell_response(traction, tension).normal(1);
    EXPECT_LT(third, previous);
    EXPECT_GT(third, 0);
    previous = third;
  }
}

}  // namespace
}  // namespace rheocyte::elastic_response_test

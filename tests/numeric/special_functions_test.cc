// Special functions against their values in NIST's Digital Library of Mathematical Functions, identities, and the
// standard library where it has them.
#include "numeric/special_functions.h"

#include <gtest/gtest.h>

#include <cmath>

namespace rheocyte::special_functions_test {
namespace {

TEST(Legendre, IsThePolynomial) {
  for (const double x : {-1.0, -0.7, 0.0, 0.3, 1.0}) {
    EXPECT_EQ(legendre(0, x), 1);
    EXPECT_EQ(legendre(1, x), x);
    EXPECT_NEAR(legendre(4, x), (35 * std::pow(x, 4) - 30 * x * x + 3) / 8, 1e-15);
  }
  for (int n = 0; n <= 30; ++n) {
    EXPECT_NEAR(legendre(n, 1), 1, 1e-14);
    EXPECT_NEAR(legendre(n, -1), n % 2 == 0 ? 1 : -1, 1e-14);
  }
  EXPECT_NEAR(legendre(20, 0.5), -0.04835838106737356, 1e-15);
}

TEST(ScaledBessel, HasThePublishedValuesAtOne) {
  const double e = std::exp(1.0);
  EXPECT_NEAR(scaled_bessel_i(0, 1) * e, 1.2660658777520083, 1e-14);
  EXPECT_NEAR(scaled_bessel_i(1, 1) * e, 0.5651591039924850, 1e-14);
  EXPECT_NEAR(scaled_bessel_k(0, 1) / e, 0.4210244382407083, 1e-14);
  EXPECT_NEAR(scaled_bessel_k(1, 1) / e, 0.6019072301972346, 1e-14);
}

TEST(ScaledBessel, FulfilsTheWronskian) {
  for (double x = 1e-3; x < 1e3; x *= 1.3) {
    const double sum = scaled_bessel_i(0, x) * scaled_bessel_k(1, x) + scaled_bessel_i(1, x) * scaled_bessel_k(0, x);
    EXPECT_NEAR(sum * x, 1, 1e-13) << x;
    // I_0 - I_2 = 2 I_1 / x, K_2 - K_0 = 2 K_1 / x
    const double i_2 = scaled_bessel_i(0, x) - 2 / x * scaled_bessel_i(1, x);
    EXPECT_NEAR(scaled_bessel_i(2, x), i_2, 1e-13 * scaled_bessel_i(0, x)) << x;
    EXPECT_NEAR(scaled_bessel_k(2, x), scaled_bessel_k(0, x) + 2 / x * scaled_bessel_k(1, x),
                1e-13 * scaled_bessel_k(2, x))
        << x;
  }
}

#if defined(__cpp_lib_math_special_functions)
TEST(SpecialFunctions, AreThoseOfTheStandardLibrary) {
  for (double x = 0.01; x < 500; x *= 1.7)
    for (const int n : {0, 1, 2}) {
      EXPECT_NEAR(scaled_bessel_i(n, x), std::exp(-x) * std::cyl_bessel_i(n, x), 1e-13 * scaled_bessel_i(n, x)) << x;
      EXPECT_NEAR(scaled_bessel_k(n, x), std::exp(x) * std::cyl_bessel_k(n, x), 1e-13 * scaled_bessel_k(n, x)) << x;
    }
  for (int n = 0; n < 30; ++n)
    for (double x = -1; x <= 1; x += 0.125) EXPECT_NEAR(legendre(n, x), std::legendre(unsigned(n), x), 1e-15);
}
#endif

}  // namespace
}  // namespace rheocyte::special_functions_test

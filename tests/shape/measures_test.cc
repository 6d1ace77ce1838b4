#include "shape/measures.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "shapes.h"

namespace rheocyte::measures_test {
namespace {

using std::numbers::pi;
using test::interpolate;

// Sums of some hundred terms of order one.
constexpr double rounding = 1e-13;
// Interpolation of a smooth curve by 10 pieces of degree 10: below rounding for the shapes used here.
constexpr test::Resolution fine{.degree = 10, .pieces = 10};

TEST(Measures, ASphereHasNoDeformation) {
  // The measures of the unit circle are pi, 2 pi, 0, 4/3 pi and 1.
  const ShapeMeasures shape = measure(interpolate(test::ellipse(1, 1), fine));
  EXPECT_NEAR(shape.area, pi, rounding);
  EXPECT_NEAR(shape.perimeter, 2 * pi, rounding);
  EXPECT_NEAR(shape.deformation, 0, rounding);
  EXPECT_NEAR(shape.volume, 4 * pi / 3, rounding);
  EXPECT_NEAR(shape.barycentre, 0, rounding);
  EXPECT_NEAR(shape.moment_ratio, 1, rounding);
  EXPECT_NEAR(shape.inertia_ratio, 1, rounding);
}

TEST(Measures, AnEllipseHasItsPerimeterFromTheCompleteEllipticIntegral) {
  // A = pi a b, P = 4 a E(k), V = 4/3 pi a b^2, Lambda1 / Lambda2 = (b/a)^2.
  const double a = 1.3, b = 0.8;
  const ShapeMeasures shape = measure(interpolate(test::ellipse(a, b), {.degree = 12, .pieces = 12}));
  const double perimeter = 4 * a * std::comp_ellint_2(std::sqrt(1 - b * b / (a * a)));
  EXPECT_NEAR(shape.area, pi * a * b, rounding);
  EXPECT_NEAR(shape.perimeter, perimeter, 10 * rounding);  // the library's elliptic integral has its own rounding
  EXPECT_NEAR(shape.deformation, 1 - 2 * std::sqrt(pi * pi * a * b) / perimeter, rounding);
  EXPECT_NEAR(shape.volume, 4 * pi / 3 * a * b * b, rounding);
  EXPECT_NEAR(shape.moment_ratio, b * b / (a * a), rounding);
  EXPECT_NEAR(shape.inertia_ratio, a / b, rounding);
  EXPECT_NEAR(shape.moment_ratio_raw, b * b / (a * a), rounding);
}

TEST(Measures, ARectangleIsExactInDegreeOne) {
  // A rectangle 4 x 2 (a cylinder of length 4, radius 1): Lambda1 = 4 2^3/12, Lambda2 = 2 4^3/12.
  const ShapeMeasures shape = measure(test::polygon({{4, 0}, {4, 1}, {0, 1}, {0, 0}}));
  EXPECT_NEAR(shape.area, 8, rounding);
  EXPECT_NEAR(shape.perimeter, 12, rounding);
  EXPECT_NEAR(shape.volume, 4 * pi, rounding);
  EXPECT_NEAR(shape.barycentre, 2, rounding);
  EXPECT_NEAR(shape.moment_ratio, 0.25, rounding);
  EXPECT_NEAR(shape.area_raw, 8, rounding);
}

TEST(Measures, ACornerAtThePoleCountsInTheBarycentreOfTheBody) {
  // A cone of height h has its barycentre at a quarter of its height, its section (a triangle) another one.
  const ShapeMeasures shape = measure(test::polygon({{3, 0}, {0, 1}, {0, 0}}));
  EXPECT_NEAR(shape.volume, pi, rounding);
  EXPECT_NEAR(shape.barycentre, 0.75, rounding);
  EXPECT_NEAR(shape.moment_ratio, (2.0 / 12) / (9.0 / 18), rounding);  // triangle: base 2, height 3
}

TEST(Measures, TheSmallestDeformationIsThatOfTheLeadingOrder) {
  // u_r = sum a_m cos(m theta): d = 1/4 sum (m^2 - 1) a_m^2; the next order is O(a^3), and rounding stays below 1e-14.
  for (double a : {1e-2, 1e-3, 1e-4}) {
    const auto radius = [a](double t) { return 1 + a * std::cos(2 * t) - 0.5 * a * std::cos(3 * t); };
    const double deformation = measure(interpolate(test::polar(radius), fine)).deformation;
    const double leading = 0.25 * (3 * a * a + 8 * 0.25 * a * a);
    EXPECT_NEAR(deformation, leading, 3 * a * a * a + 1e-14) << a;
  }
}

TEST(Measures, SmallDeformationsAreGoodToThirteenDigitsAbsolute) {
  // A nearly circular ellipse has d = 3/4 e^2 with an error O(e^4): at e = 1e-4 known to 1e-16.
  const double e = 1e-4;
  const double deformation = measure(interpolate(test::ellipse(1 + e, (1 - e)), fine)).deformation;
  EXPECT_NEAR(deformation, 0.75 * e * e, 1e-14);  // a hundred times rounding, a tenth of what is promised
}

TEST(Measures, TheModesOfTheRadiusAreThoseThatTheOutlineWasMadeOf) {
  // Without a first mode about the point it was drawn round, so the centroid is moved by second order: there the modes
  // change by at most the product of two of them.
  const auto radius = [](double t) {
    return 2 * (1 + 1e-5 * std::cos(2 * t) - 3e-5 * std::cos(3 * t) + 2e-5 * std::cos(7 * t));
  };
  const ShapeMeasures shape = measure(test::transformed(interpolate(test::polar(radius), fine), 1.5, 0.7));
  const RadiusModes expected{1e-5, -3e-5, 0, 0, 0, 2e-5};
  for (std::size_t k = 0; k < expected.size(); ++k) {
    EXPECT_NEAR(shape.modes[k], expected[k], 1e-8) << k;
    EXPECT_NEAR(shape.modes_raw[k], expected[k], 1e-8) << k;
  }
}

TEST(Measures, TheModesOfAnEllipseAreThoseOfItsRadius) {
  // r(theta) = a b / sqrt(b^2 cos^2 + a^2 sin^2), by the trapezoidal rule, which is exact for periodic functions.
  const double a = 1.3, b = 0.8;
  const int points = 400;
  std::array<double, last_radius_mode + 1> sum{};
  for (int i = 0; i < points; ++i) {
    const double t = 2 * pi * i / points, r = a * b / std::hypot(b * std::cos(t), a * std::sin(t));
    for (int k = 0; k <= last_radius_mode; ++k) sum[std::size_t(k)] += r * std::cos(k * t);
  }
  const ShapeMeasures shape = measure(interpolate(test::ellipse(a, b), {.degree = 12, .pieces = 12}));
  for (int k = first_radius_mode; k <= last_radius_mode; ++k)
    EXPECT_NEAR(shape.modes[std::size_t(k - first_radius_mode)], 2 * sum[std::size_t(k)] / sum[0], 10 * rounding) << k;
}

TEST(Measures, ADentedContourAndItsHullHaveModesOfTheirOwn) {
  const auto radius = [](double t) { return 1 - 0.3 * std::exp(-4 * (t - pi) * (t - pi)); };
  const ShapeMeasures shape = measure(interpolate(test::polar(radius), fine));
  EXPECT_GT(std::abs(shape.modes[1] - shape.modes_raw[1]), 1e-2);
}

TEST(Measures, ScaleAndTranslationChangeNothingButTheUnit) {
  // Dimensionless measures are invariant, lengths scale with their power.
  const auto egg = interpolate(test::polar([](double t) { return 1 + 0.1 * std::cos(t) - 0.05 * std::cos(2 * t); }));
  const double scale = 7.66, shift = 31;
  const ShapeMeasures one = measure(egg), other = measure(test::transformed(egg, scale, shift));
  EXPECT_NEAR(other.deformation, one.deformation, rounding);
  EXPECT_NEAR(other.moment_ratio, one.moment_ratio, rounding);
  EXPECT_NEAR(other.area / (scale * scale), one.area, rounding);
  EXPECT_NEAR(other.volume / std::pow(scale, 3), one.volume, rounding);
  EXPECT_NEAR(other.barycentre, scale * one.barycentre + shift, 40 * rounding);  // coordinates are near 40
}

TEST(Measures, TheDeformationConvergesExponentiallyInTheDegree) {
  // Six pieces of an ellipse: two degrees more gain at least a factor 30, until rounding is reached.
  const double a = 1.2, b = 0.9;
  const double perimeter = 4 * a * std::comp_ellint_2(std::sqrt(1 - b * b / (a * a)));
  const double exact = 1 - 2 * pi * std::sqrt(a * b) / perimeter;
  double previous = 1;
  for (int degree = 1; degree <= 11; degree += 2) {
    const double error =
        std::abs(measure(interpolate(test::ellipse(a, b), {.degree = degree, .pieces = 6})).deformation - exact);
    EXPECT_LT(error, std::max(previous / 30, rounding)) << "degree " << degree;
    previous = error;
  }
}

TEST(Measures, APolygonAddsItsOwnDeformation) {
  // An inscribed M-gon has d = (pi^2/6)/M^2: the reason why the curve is integrated and not a polygon of its points.
  for (int half : {40, 80, 160}) {
    const int corners = 2 * half;
    const double deformation = measure(interpolate(test::ellipse(1, 1), {.degree = 1, .pieces = half})).deformation;
    // Next term of 1 - sqrt((pi/M)/tan(pi/M)): 7/360 (pi/M)^4 + ..., less than 10/M^4.
    EXPECT_NEAR(deformation, pi * pi / 6 / (corners * corners), 10 / std::pow(corners, 4)) << corners;
  }
}

TEST(Measures, ADegenerateContourHasNoMeasures) {
  // Empty, not finite, torn, reversed, off the axis, negative radius, self-crossing, flat: NaN, never a crash.
  std::vector<Contour> bad(1);
  bad.push_back(interpolate(test::ellipse(1, 1)));
  bad.back().pieces[3](2, 1) = std::nan("");
  bad.push_back(interpolate(test::ellipse(1, 1)));
  bad.back().pieces[4].col(0).array() += 0.01;
  bad.push_back(interpolate(test::ellipse(-1, 1)));
  bad.push_back(interpolate(test::ellipse(1, -1)));
  bad.push_back(test::polygon({{1, 0.1}, {0, 1}, {-1, 0}}));
  bad.push_back(test::polygon({{2, 0}, {2, 1}, {0, 1}, {0, 0.5}, {1, 2}, {-1, 2}, {-1, 0}}));
  bad.push_back(test::polygon({{1, 0}, {0, 0}}));
  bad.push_back(test::polygon({{0, 0}, {0, 0}}));
  bad.push_back({{CurvePiece(1, 2)}});
  bad.push_back({{CurvePiece::Zero(30, 2)}});
  for (std::size_t i = 0; i < bad.size(); ++i) {
    const ShapeMeasures shape = measure(bad[i]);
    EXPECT_TRUE(std::isnan(shape.deformation) && std::isnan(shape.area) && std::isnan(shape.moment_ratio_raw)) << i;
  }
}

}  // namespace
}  // namespace rheocyte::measures_test

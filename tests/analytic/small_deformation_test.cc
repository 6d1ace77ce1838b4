// Reference values: an implementation in another language with trapezoidal contour integrals.
#include "analytic/small_deformation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace rheocyte::small_deformation_test {
namespace {

using std::numbers::pi;

// Half a unit of the reference's ninth digit, truncation of the series, and rounding of 1 - 2 sqrt(pi A) / P.
double tolerance(double deformation) { return 5.2e-9 * deformation + 1e-14; }

double solid_deformation(double lambda, double capillary_number) {
  return small_deformation(solid_in_tube(lambda), solid_strain(capillary_number)).shape.deformation;
}

double shell_deformation(double lambda, double capillary_number) {
  return small_deformation(shell_in_tube(lambda, 0.1), shell_strain(capillary_number, lambda)).shape.deformation;
}

TEST(SmallDeformation, SolidsDeformAsInTheReference) {
  // Deformation of solids for six capillary numbers and nine radii; hulls where the rear is concave.
  constexpr double capillary[] = {0.001, 0.005, 0.01, 0.02, 0.03, 0.04};
  constexpr double expected[9][6] = {
      {2.18193725e-08, 5.45484346e-07, 2.18193775e-06, 8.72775693e-06, 1.96374752e-05, 3.49111222e-05},
      {8.74740234e-08, 2.18685105e-06, 8.74741007e-06, 3.49897339e-05, 7.87272518e-05, 1.39960429e-04},
      {1.99556797e-07, 4.98892216e-06, 1.99557166e-05, 7.98233128e-05, 1.79604122e-04, 3.19300344e-04},
      {3.70885854e-07, 9.27215194e-06, 3.70886777e-05, 1.48355826e-04, 3.33804751e-04, 5.93440843e-04},
      {6.41486631e-07, 1.60371696e-05, 6.41487260e-05, 2.56595644e-04, 5.77342804e-04, 1.02639305e-03},
      {1.12095549e-06, 2.80238381e-05, 1.12094738e-04, 4.48369026e-04, 1.00879235e-03, 1.79331141e-03},
      {2.15020853e-06, 5.37547463e-05, 2.15013140e-04, 8.59958576e-04, 1.93455063e-03, 3.43830082e-03},
      {5.25041472e-06, 1.31255351e-04, 5.24958632e-04, 2.09882640e-03, 4.71854902e-03, 8.37893723e-03},
      {2.56384936e-05, 6.40692237e-04, 2.55939923e-03, 1.01438e-02, 2.12393e-02, 3.44602e-02}};
  for (int row = 0; row < 9; ++row)
    for (int column = 0; column < 6; ++column) {
      const double d = expected[row][column];
      const bool hull = row == 8 && column >= 3;  // six digits, and a polygon's hull
      EXPECT_NEAR(solid_deformation(0.1 * (row + 1), capillary[column]), d, hull ? 5e-6 * d : tolerance(d))
          << row << ' ' << column;
    }
}

TEST(SmallDeformation, ShellsDeformAsInTheReference) {
  // Deformation of shells with a tension of 0.1 E2D for five capillary numbers and nine radii.
  constexpr double capillary[] = {0.005, 0.01, 0.02, 0.05, 0.1};
  constexpr double expected[9][5] = {{6.42478992e-09, 2.56991592e-08, 1.02796627e-07, 6.42478451e-07, 2.56990714e-06},
                                     {1.03028736e-07, 4.12114773e-07, 1.64845635e-06, 1.03027323e-05, 4.12092167e-05},
                                     {5.28890812e-07, 2.11555874e-06, 8.46216276e-06, 5.28853591e-05, 2.11496330e-04},
                                     {1.74836230e-06, 6.99339997e-06, 2.79728124e-05, 1.74795631e-04, 6.98690758e-04},
                                     {4.73254614e-06, 1.89298261e-05, 7.57135695e-05, 4.72959027e-04, 1.88826040e-03},
                                     {1.19484276e-05, 4.77914583e-05, 1.91129809e-04, 1.19298729e-03, 4.74957841e-03},
                                     {3.13142863e-05, 1.25242044e-04, 5.00726683e-04, 3.11901401e-03, 1.23277983e-02},
                                     {9.93671391e-05, 3.97318424e-04, 1.58687628e-03, 9.81439550e-03, 3.70060e-02},
                                     {5.75967621e-04, 2.29812232e-03, 9.10144e-03, 4.31001e-02, NAN}};
  for (int row = 0; row < 9; ++row)
    for (int column = 0; column < 5; ++column) {
      const double d = expected[row][column];
      if (std::isnan(d)) continue;  // not in the reference
      const bool hull = (row == 7 && column == 4) || (row == 8 && column >= 2);
      EXPECT_NEAR(shell_deformation(0.1 * (row + 1), capillary[column]), d, hull ? 5e-6 * d : tolerance(d))
          << row << ' ' << column;
    }
}

TEST(SmallDeformation, TheLeadingOrderIsThatOfTheReference) {
  // d / Ca^2 for Ca -> 0, from the cosine coefficients of the radial displacement.
  constexpr double solid[] = {2.18193726e-02, 8.74740227e-02, 1.99556793e-01, 3.70885844e-01, 6.41486625e-01,
                              1.12095557e+00, 2.15020931e+00, 5.25042308e+00, 2.56389440e+01};
  constexpr double shell[] = {2.56991602e-04, 4.12115001e-03, 2.11556475e-02, 6.99346560e-02, 1.89303040e-01,
                              4.77944609e-01, 1.25262180e+00, 3.97518627e+00, 2.30579569e+01};
  for (int row = 0; row < 9; ++row) {
    const double lambda = 0.1 * (row + 1);
    const double of_solid = leading_deformation(solid_in_tube(lambda)) * std::pow(solid_strain(1), 2);
    const double of_shell = leading_deformation(shell_in_tube(lambda, 0.1)) * std::pow(shell_strain(1, lambda), 2);
    EXPECT_NEAR(of_solid / solid[row], 1, 5e-9) << lambda;  // digits of the reference
    EXPECT_NEAR(of_shell / shell[row], 1, 5e-9) << lambda;
  }
}

TEST(SmallDeformation, SmallCellsFollowPowersOfTheirRadius) {
  // lambda -> 0: solid d = 2.18176963 (lambda Ca)^2, shell with gamma = 0.1 E2D d = 2.56971845 (lambda^2 Ca)^2.
  const double lambda = 0.01;
  const double solid = leading_deformation(solid_in_tube(lambda)) * std::pow(solid_strain(1), 2);
  const double shell = leading_deformation(shell_in_tube(lambda, 0.1)) * std::pow(shell_strain(1, lambda), 2);
  const double next_order = 10 * std::pow(lambda, 3);
  EXPECT_NEAR(solid / std::pow(lambda, 2), 2.18176963, next_order);
  EXPECT_NEAR(shell / std::pow(lambda, 4), 2.56971845, next_order);
}

TEST(SmallDeformation, TheDeformationTendsToItsLeadingOrder) {
  // d / (leading order) - 1 falls with the square of the strain: each halving gains four.
  const CellInTube cell = solid_in_tube(0.8);
  const auto rest = [&](double strain) {
    const double leading = leading_deformation(cell) * strain * strain;
    return small_deformation(cell, strain).shape.deformation_raw / leading - 1;
  };
  const double coarse = rest(0.04), fine = rest(0.02);
  EXPECT_LT(std::abs(coarse), 1e-3);
  EXPECT_NEAR(coarse / fine, 4, 0.05);
}

// Area and perimeter of the closed section by the trapezoidal rule at equal angles, which is spectrally accurate; the
// tangents by a spectral stencil would only repeat the model, so the polygon is extrapolated to h^8 instead.
double polygon_deformation(const CellInTube& cell, double strain, int half_corners) {
  const Eigen::MatrixX2d p = surface_points(cell, strain, Eigen::ArrayXd::LinSpaced(half_corners + 1, 0, pi));
  double area = 0, perimeter = 0;
  for (int i = 0; i < half_corners; ++i) {
    area += p(i, 0) * p(i + 1, 1) - p(i + 1, 0) * p(i, 1);
    perimeter += 2 * (p.row(i + 1) - p.row(i)).norm();
  }
  return 1 - 2 * std::sqrt(pi * area) / perimeter;
}

TEST(SmallDeformation, TheCurvesIntegralsAgreeWithPolygons) {
  // Richardson extrapolation of the deformation of polygons, whose errors are even powers of the corners' distance.
  for (const double lambda : {0.3, 0.6, 0.9}) {
    const CellInTube cell = solid_in_tube(lambda);
    const double strain = solid_strain(0.005);
    double table[4];
    for (int i = 0; i < 4; ++i) table[i] = polygon_deformation(cell, strain, 200 << i);
    for (int order = 1; order < 4; ++order)
      for (int i = 0; i + order < 4; ++i)
        table[i] = table[i + 1] + (table[i + 1] - table[i]) / (std::pow(4, order) - 1);
    const double raw = small_deformation(cell, strain).shape.deformation_raw;
    EXPECT_NEAR(raw, table[0], 1e-12) << lambda;  // sums of 3200 sides
  }
}

TEST(SmallDeformation, VolumeIsKeptToFirstOrderOnly) {
  // lambda = 0.5, Ca = 0.02: -1.7e-4 (two digits of the reference); half the strain, a quarter of the change.
  const CellInTube cell = solid_in_tube(0.5);
  const double rest = 4.0 / 3 * pi * std::pow(0.5, 3);
  const auto change = [&](double capillary) {
    return small_deformation(cell, solid_strain(capillary)).shape.volume / rest - 1;
  };
  EXPECT_NEAR(change(0.02), -1.7e-4, 0.05e-4);
  EXPECT_NEAR(change(0.02) / change(0.01), 4, 0.01);
}

TEST(SmallDeformation, ARigidShiftChangesNoMeasure) {
  // Material points are moved, so a translation (w_1, v_1) += (c, c) only shifts the contour by c.
  CellInTube cell = solid_in_tube(0.6);
  const ShapeMeasures before = small_deformation(cell, 0.05).shape;
  cell.displacement.normal(0) += 1;
  cell.displacement.tangential(0) += 1;
  const ShapeMeasures after = small_deformation(cell, 0.05).shape;
  EXPECT_NEAR(after.deformation, before.deformation, 1e-13);
  EXPECT_NEAR(after.area, before.area, 1e-13);
  EXPECT_NEAR(after.barycentre - before.barycentre, 0.05 * 0.6, 1e-13);
}

TEST(SmallDeformation, TheContourRunsFromFrontToRearPole) {
  // surface_points at the ends of the angles lie on the axis, at the poles of the contour.
  const CellInTube cell = shell_in_tube(0.7, 0.1);
  const Contour meridian = contour(cell, 0.01);
  const Eigen::MatrixX2d ends = surface_points(cell, 0.01, Eigen::Array2d(0, pi));
  EXPECT_NEAR(meridian.pieces.front()(0, 0), ends(0, 0), 1e-15);
  EXPECT_NEAR(meridian.pieces.back().bottomRows(1)(0, 0), ends(1, 0), 1e-15);
  EXPECT_EQ(meridian.pieces.front()(0, 1), 0);
  EXPECT_GT(ends(0, 0), 0);
  EXPECT_LT(ends(1, 0), 0);
}

TEST(SmallDeformation, FarBeyondTheModelThereAreNoMeasures) {
  // A strain of a thousand turns the linear shape inside out: NaN, never a crash.
  EXPECT_TRUE(std::isnan(small_deformation(solid_in_tube(0.5), 1000).shape.deformation));
}

TEST(PeakVelocity, OfTheSquareDuctComesFromItsSeries) {
  // Poiseuille flow in the unit square: velocity on the axis over flow rate from the series in cosines and cosh.
  double axis = 0, rate = 0;
  for (int n = 1; n < 2000; n += 2) {  // the rate's terms fall like n^-4: the rest is below 1e-11
    const double a = n * pi, sign = n % 4 == 1 ? 1 : -1;
    axis += sign * 4 / (a * a * a) * (1 - (a / 2 < 700 ? 1 / std::cosh(a / 2) : 0));
    rate += 8 / std::pow(a, 4) * (1 - 2 / a * std::tanh(a / 2));
  }
  const double per_width = peak_velocity(Duct::square) / (0.547 * 0.547);
  EXPECT_NEAR(axis / rate, 2.0962560, 1e-7);    // the exact value
  EXPECT_NEAR(per_width, axis / rate, 0.5e-4);  // the published tables' value has four decimals
  EXPECT_NEAR(peak_velocity(Duct::square) / peak_velocity(Duct::tube), 0.985253, 5e-7);
}

}  // namespace
}  // namespace rheocyte::small_deformation_test

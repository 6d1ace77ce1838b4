// Dense output of a branch has the order of Hermite interpolation through four samples; inversion gives back the
// stiffness.
#include "table/branch.h"

#include <gtest/gtest.h>

#include "invented_branch.h"

namespace rheocyte::branch_test {
namespace {

using namespace test;

constexpr double radius = 7;

double max_error(const SampledBranch& branch, Measure m) {
  double greatest = 0;
  for (int i = 0; i <= 400; ++i) {
    const double stiffness =
        branch.stiffness.front() * std::pow(branch.stiffness.back() / branch.stiffness.front(), i / 400.0);
    const double inside = std::clamp(stiffness, branch.stiffness.back(), branch.stiffness.front());
    const double exact = invented_state(radius, inside)(int(m), 0);
    greatest = std::max(greatest, std::abs(interpolate(branch, m, inside) / exact - 1));
  }
  return greatest;
}

TEST(Branch, SamplesAreGivenBackExactly) {
  const auto branch = invented_branch(radius);
  for (int i = 0; i < branch.samples(); ++i) {
    const auto values = interpolate(branch, branch.stiffness[std::size_t(i)]);
    // The logarithm and the exponential of the deformations round twice.
    for (int m = 0; m < measure_count; ++m)
      EXPECT_NEAR(values(m), branch.value(i, m), 1e-14 * std::abs(branch.value(i, m)));
  }
}

TEST(Branch, InterpolationHasOrderEight) {
  for (const auto m :
       {Measure::deformation, Measure::area_um2, Measure::named("perimeter_um"), Measure::named("inertia_ratio")}) {
    const double coarse = max_error(invented_branch(radius, {30, 0.3, 17}), m);
    const double fine = max_error(invented_branch(radius, {30, 0.3, 33}), m);
    EXPECT_GT(coarse / fine, 150) << int(m);  // 256 in the limit of small steps
    EXPECT_LT(fine, 1e-7) << int(m);
  }
}

TEST(Branch, TheStiffnessAtAMeasureInvertsTheInterpolation) {
  const auto branch = invented_branch(radius);
  for (const auto m : {Measure::deformation, Measure::area_um2, Measure::named("inertia_ratio"), Measure::moment_ratio})
    for (int i = 0; i <= 200; ++i) {
      const double stiffness = std::exp(std::log(30.0) + (std::log(0.3) - std::log(30.0)) * i / 200);
      const double inside = std::clamp(stiffness, branch.stiffness.back(), branch.stiffness.front());
      // The area of stiff cells hardly depends on the stiffness: 1e-16 of it are 1e-12 of the stiffness and more.
      const double tolerance = m == Measure::deformation ? 1e-13 : 1e-9;
      EXPECT_NEAR(stiffness_at(branch, m, interpolate(branch, m, inside)) / inside, 1, tolerance) << int(m) << " " << i;
    }
}

TEST(Branch, OutsideTheSamplesThereIsNoStiffness) {
  const auto branch = invented_branch(radius);
  const double least = branch.at(0, Measure::deformation), greatest = branch.at(23, Measure::deformation);
  EXPECT_TRUE(std::isnan(stiffness_at(branch, Measure::deformation, 0.999 * least)));
  EXPECT_TRUE(std::isnan(stiffness_at(branch, Measure::deformation, 1.001 * greatest)));
  EXPECT_TRUE(std::isnan(stiffness_at(branch, Measure::deformation, std::nan(""))));
  EXPECT_TRUE(std::isnan(stiffness_at(SampledBranch{}, Measure::deformation, 0.1)));
  EXPECT_EQ(stiffness_at(branch, Measure::deformation, least), branch.stiffness.front());
  EXPECT_EQ(stiffness_at(branch, Measure::deformation, greatest), branch.stiffness.back());
}

TEST(Branch, ContoursAreInterpolatedWithTheSameOrder) {
  const auto error = [](int samples) {
    const auto branch = invented_branch(radius, {30, 0.3, samples});
    double greatest = 0;
    for (int i = 0; i < samples - 1; ++i) {
      const double stiffness = std::sqrt(branch.stiffness[std::size_t(i)] * branch.stiffness[std::size_t(i) + 1]);
      const auto exact = invented_contour(radius, invented_deformation(radius, stiffness));
      greatest = std::max(greatest, (interpolate_contour(branch, stiffness) - exact).cwiseAbs().maxCoeff());
    }
    return greatest;
  };
  EXPECT_GT(error(17) / error(33), 150);
  EXPECT_LT(error(33), 1e-6);  // um
}

TEST(Branch, NoPolynomialRunsAcrossTheAppearanceOfADent) {
  // Smooth on both sides; beyond the onset the deformation of the outline and that of its hull differ.
  const auto branch = [] {
    auto kinked = invented_branch(radius, {30, 0.3, 25});
    for (int i = 0; i < kinked.samples(); ++i) {
      const double c = 1 / kinked.stiffness[std::size_t(i)], x = std::max(0.0, c - 1);
      kinked.value(i, int(Measure::deformation_raw)) = kinked.at(i, Measure::deformation) * (1 + x);
      kinked.value(i, int(Measure::area_um2)) = 100 + x * x;
      kinked.slope(i, int(Measure::area_um2)) = -2 * x * c;
    }
    return kinked;
  }();
  for (int i = 0; i + 1 < branch.samples(); ++i) {
    const double c = 0.5 / branch.stiffness[std::size_t(i)] + 0.5 / branch.stiffness[std::size_t(i) + 1];
    const bool holds_onset = 1 / branch.stiffness[std::size_t(i)] < 1 && 1 / branch.stiffness[std::size_t(i) + 1] > 1;
    const double exact = 100 + std::pow(std::max(0.0, c - 1), 2);
    EXPECT_NEAR(interpolate(branch, Measure::area_um2, 1 / c), exact, holds_onset ? 1e-2 : 1e-10) << c;
  }
}

TEST(Branch, ASingleSampleIsABranch) {
  auto branch = invented_branch(radius);
  const auto one = [](auto& list) { list.resize(1); };
  one(branch.stiffness), one(branch.error), one(branch.contour), one(branch.contour_slope);
  branch.value.conservativeResize(1, measure_count);
  branch.slope.conservativeResize(1, measure_count);
  EXPECT_EQ(interpolate(branch, 30)(0), branch.value(0, 0));
  EXPECT_EQ(interpolate_contour(branch, 30), branch.contour[0]);
  EXPECT_EQ(stiffness_at(branch, Measure::deformation, branch.value(0, 0)), 30);
}

}  // namespace
}  // namespace rheocyte::branch_test

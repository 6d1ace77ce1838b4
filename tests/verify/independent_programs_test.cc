// Programs that were written independently, with other elements and other unknowns, find the same shapes.
#include <gtest/gtest.h>

#include <string>

#include "laboratory.h"
#include "solve/stationary.h"

namespace rheocyte::independent_programs_test {
namespace {

using test::Inertia;
using test::LaboratoryCell;

/// Stokes flow, R = 10.94 um, 0.04 ul/s, 15 mPa s. Values of a prototype with polynomials of high degree, converged to
/// about 3e-5; a second program, with quadratic triangles, has 0.0086122 and 0.038245 (docs/verification.md).
struct IndependentValue {
  std::string name;
  LaboratoryCell cell;
  double deformation;
  double digit;         ///< half of the last digit that was stated, relative
  double area_um2 = 0;  ///< 0: not stated
};
const IndependentValue values[] = {
    {"linear_6um_11kPa", {6, 11.45, BulkLaw::linear}, 0.0013446, 4e-5},
    {"linear_6um_7kPa", {6, 6.87, BulkLaw::linear}, 0.0037655, 2e-5},
    {"linear_6um_5kPa", {6, 4.58, BulkLaw::linear}, 0.0086122, 1e-5},
    {"linear_6um_3kPa", {6, 3.44, BulkLaw::linear}, 0.015638, 4e-5},
    {"linear_6um_2kPa", {6, 2.29, BulkLaw::linear}, 0.038244, 2e-5, 118.076},
    {"linear_8um_3kPa", {7.66, 3.437, BulkLaw::linear}, 0.04279, 12e-5, 198.02},
    {"neo_hookean_8um_3kPa", {7.66, 3.437, BulkLaw::neo_hookean}, 0.03609, 14e-5, 190.18},
};

class IndependentPrograms : public testing::TestWithParam<IndependentValue> {};

TEST_P(IndependentPrograms, FindTheSameDeformationAndArea) {
  // d within the reference's own error of 3e-5 and half its last digit; the area within half its last digit and 1e-5.
  const IndependentValue& value = GetParam();
  const StationaryState state = solve_stationary(test::in_newtonian_liquid(value.cell, Inertia::none, 1e-6));
  ASSERT_EQ(state.outcome.status, Status::converged) << state.outcome.message;
  EXPECT_NEAR(state.shape.deformation / value.deformation, 1, 3e-5 + value.digit);
  if (value.area_um2 > 0) {
    const double area = state.shape.area * test::tube_radius_um * test::tube_radius_um;
    EXPECT_NEAR(area / value.area_um2, 1, 4e-5);  // half of 0.01 um2 in 190 um2 is 2.6e-5
  }
}

INSTANTIATE_TEST_SUITE_P(Case, IndependentPrograms, testing::ValuesIn(values),
                         [](const auto& test) { return test.param.name; });

}  // namespace
}  // namespace rheocyte::independent_programs_test

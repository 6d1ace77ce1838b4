// Young's modulus of elongated cells from area and two numbers of the outline.
#include "infer/elongated_solids.h"

#include <gtest/gtest.h>

#include <cmath>

#include "../table/invented_elongated.h"
#include "laws/uniaxial.h"
#include "measurement/pixel_errors.h"

namespace rheocyte::elongated_solids_test {
namespace {

using test::InventedElongated;

struct Told {
  double modulus = 0, error = 0, elongation = 0, elongation_error = 0, tension = 0, tension_error = 0;
  ModulusState state = ModulusState::valid;
  ElongatedCell cell;
};

class Elongated : public testing::Test {
 protected:
  Told told(ElongatedBy by, double area, double first, double second,
            const MeasuringConditions& conditions = {{20, 0.04}, 0}, double viscosity = 15) const {
    Told t;
    const double deformation = by == ElongatedBy::modes ? 0.02 : second, none = 0;  // of the next modes
    solids_.estimate(conditions, {{&area, 1}, {&deformation, 1}, {&viscosity, 1}},
                     {by, {&first, 1}, {&second, 1}, {&none, 1}, {&none, 1}},
                     {{{&t.modulus, 1}, {&t.error, 1}, {&t.state, 1}},
                      {&t.elongation, 1},
                      {&t.elongation_error, 1},
                      {&t.tension, 1},
                      {&t.tension_error, 1},
                      {&t.cell, 1}});
    return t;
  }
  Told by_modes(const InventedElongated& c) const {
    return told(ElongatedBy::modes, c.area_um2(), c.mode_2(), c.mode_3());
  }
  ElongatedSolids solids_{test::invented_elongated_content()};
};

TEST_F(Elongated, ModulusAndTensionAreThoseOfTheCellByItsModesAndByItsInertia) {
  for (const double axial : {-0.06, 0.0, 0.15, 0.4})
    for (const double modulus : {4.0, 1.7}) {
      const InventedElongated cell{6.3, axial, modulus};
      for (const Told& t :
           {by_modes(cell), told(ElongatedBy::inertia, cell.area_um2(), cell.inertia_ratio(), cell.deformation())}) {
        ASSERT_EQ(t.state, ModulusState::valid) << axial << " " << modulus;
        EXPECT_NEAR(t.modulus, modulus, 2e-3 * modulus) << axial;
        EXPECT_NEAR(t.tension, 1e3 * axial * modulus, 4 * modulus) << axial;
        EXPECT_NEAR(t.elongation, aspect_by_tension(axial), 2e-3);
      }
    }
}

TEST_F(Elongated, InAnotherChannelTheModulusScalesAsTheEquations) {
  const InventedElongated cell{6.3, 0.15, 2};
  const double factor = (0.16 / 0.04) * (5.5 / 15) * std::pow(20. / 30, 3);
  const Told t = told(ElongatedBy::modes, cell.area_um2() * 2.25, cell.mode_2(), cell.mode_3(), {{30, 0.16}, 0}, 5.5);
  EXPECT_NEAR(t.modulus, 2 * factor, 4e-3 * factor);
  EXPECT_NEAR(t.tension / t.modulus, 1e3 * 0.15, 1);
}

TEST_F(Elongated, OutsideTheTableTheReasonIsNamed) {
  const InventedElongated cell{6.3, 0.15, 2};
  const double area = cell.area_um2(), second = cell.mode_2(), third = cell.mode_3();
  const auto state = [&](double a, double b, double c) { return told(ElongatedBy::modes, a, b, c).state; };
  EXPECT_EQ(state(area, 0.6, third), ModulusState::too_elongated);
  EXPECT_EQ(state(area, -0.3, third), ModulusState::too_round);
  EXPECT_EQ(state(area, second, 0), ModulusState::too_stiff);
  EXPECT_EQ(state(area, second, -0.05), ModulusState::too_stiff) << "the other way round";
  EXPECT_EQ(state(area, second, 0.4), ModulusState::too_soft);
  EXPECT_EQ(state(5, second, third), ModulusState::too_small);
  EXPECT_EQ(state(900, second, third), ModulusState::too_large);
  EXPECT_EQ(state(area, second, NAN), ModulusState::no_data);
  EXPECT_EQ(state(NAN, second, third), ModulusState::no_data);
  EXPECT_TRUE(std::isnan(told(ElongatedBy::modes, area, 0.6, third).modulus));
  EXPECT_TRUE(std::isnan(told(ElongatedBy::modes, area, second, third, {{20, 0.04}, 0}, NAN).modulus));
}

TEST_F(Elongated, TheErrorIsThatOfThePixelsThroughTheTable) {
  const InventedElongated cell{6.3, 0.15, 2};
  const double log_area_px = std::log(cell.area_um2() / (0.34 * 0.34));
  const ModeErrors pixels = mode_errors(log_area_px, {cell.mode_2(), cell.mode_3()});
  const Told t = told(ElongatedBy::modes, cell.area_um2(), cell.mode_2(), cell.mode_3(), {{20, 0.04}, 0.34});
  // E goes about as 1 / c_3, and as c_2 by the 0.9 / 0.75 with which a long cell leaves the flow less to do.
  const double expected = std::hypot(pixels.mode_3.deviation / cell.mode_3(), 1.4 * pixels.mode_2.deviation);
  EXPECT_NEAR(t.error / t.modulus, expected, 0.25 * expected);
}

TEST(AspectByTension, IsThatOfANeoHookeanSphere) {
  // docs/theory.md, sec. "Elongated cells": E = 2 kPa under 500 and 1000 Pa.
  EXPECT_NEAR(aspect_by_tension(0.25), 1.39087, 1e-5);
  EXPECT_NEAR(aspect_by_tension(0.5), 1.79263, 1e-5);
  for (const double ratio : {-0.3, 0.0, 0.25, 0.9})
    EXPECT_NEAR(tension_by_aspect(aspect_by_tension(ratio)), ratio, 1e-12);
  EXPECT_EQ(aspect_by_tension(0), 1);
  EXPECT_LT(aspect_by_tension(-0.1), 1);
}

}  // namespace
}  // namespace rheocyte::elongated_solids_test

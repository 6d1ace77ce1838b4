#include "duct/duct_flow.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "laws/developed_flow.h"

namespace rheocyte::duct_flow_test {
namespace {

const DuctGeometry square(Section::square, 0.5), circle(Section::tube, 0.5);

TEST(DuctFlow, NewtonianFlowThroughASquareIsThatOfTheSeries) {
  const CrossSection section(square, 12);
  const DuctFlow flow = section.flow({});
  // The classical Fourier series, to all digits that are quoted.
  EXPECT_NEAR(flow.pressure_gradient, 7.113538, 1e-6);
  EXPECT_NEAR(flow.velocity(section.node_at({0, 0})), 2.0962, 1e-4);  // of which the last digit was cut
  EXPECT_NEAR(section.mean(flow.velocity), 1, 1e-12);
}

/// The Fourier series of the flow through a rectangle with sides 2 and 2 wide.
double series(double wide) {
  double sum = 0;
  for (int i = 1; i < 400; i += 2) sum += std::tanh(i * std::numbers::pi * wide / 2) / std::pow(i, 5);
  return 3 / (1 - 192 / std::pow(std::numbers::pi, 5) / wide * sum);
}

TEST(DuctFlow, NewtonianFlowThroughRectanglesIsThatOfTheSeries) {
  for (const double wide : {1.0, 1.5, 3.0, 4.0}) {
    for (const Extent& extent : {Extent{wide, 1}, Extent{1, wide}}) {
      const CrossSection section(DuctGeometry({Section::rectangle, 0.5, extent}), 10);
      EXPECT_NEAR(section.flow({}).pressure_gradient / series(wide), 1, 1e-6) << wide;
    }
  }
}

TEST(DuctFlow, AnotherSpeedTakesTheGradientOfThatSpeed) {
  const CrossSection section(square, 5);
  const Liquid power_law{.law = LiquidLaw::power_law, .exponent = 0.6, .shear_rate_floor = 1e-3};
  EXPECT_NEAR(section.gradient_at({.viscosity = 3}, 2), 6 * section.flow({}).pressure_gradient, 1e-9);
  // The floor is at another fraction of the speed: 1e-5 of the stress.
  EXPECT_NEAR(section.gradient_at(power_law, 2) / (std::pow(2, 0.6) * section.flow(power_law).pressure_gradient), 1,
              2e-5);
}

TEST(DuctFlow, PowerLawsThroughASquareHaveThePublishedFrictionFactors) {
  const CrossSection section(square, 12);
  const double exponents[] = {0.9, 0.8, 0.7, 0.6, 0.5}, factors[] = {11.881, 9.915, 8.267, 6.884, 5.7214};
  for (int i = 0; i < 5; ++i) {
    const double n = exponents[i];
    const Liquid liquid{.law = LiquidLaw::power_law, .exponent = n, .shear_rate_floor = 1e-4};
    // Fanning factor times the Reynolds number of the hydraulic diameter; half a digit of the tables is 1e-4.
    EXPECT_NEAR(std::pow(2, n) * section.flow(liquid).pressure_gradient / factors[i], 1, 1.2e-4) << n;
  }
}

TEST(DuctFlow, TheCircleIsTheTube) {
  const Liquid newtonian, power_law{.law = LiquidLaw::power_law, .exponent = 0.6, .shear_rate_floor = 1e-3},
      carreau{
          .law = LiquidLaw::carreau, .exponent = 0.4, .viscosity = 3, .infinite_viscosity = 0.2, .relaxation_time = 2};
  const CrossSection section(circle, 10);
  for (const Liquid& liquid : {newtonian, power_law, carreau}) {
    const DuctFlow flow = section.flow(liquid);
    // The floor of the power law, which the closed form leaves out, is about 1e-5 of the stress.
    EXPECT_NEAR(flow.pressure_gradient / undisturbed_pressure_gradient(liquid), 1, 2e-5);
    const int centre = section.node_at({0, 0});
    EXPECT_NEAR(flow.velocity(centre) / undisturbed_velocity(liquid, 0), 1, 1e-3);
  }
}

}  // namespace
}  // namespace rheocyte::duct_flow_test

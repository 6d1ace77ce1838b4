// Which table of cells with a cortex serves which liquid.
#include <gtest/gtest.h>

#include "shelf/modulus_tables.h"

namespace rheocyte::proportioned_tables_test {
namespace {

/// The media of the viscosity model: water, and 0.49, 0.59 and 0.83 % methyl cellulose at 23 degC.
TEST(ProportionedTables, EachMediumHasATableOfItsOwn) {
  const ModulusTables tables("");
  for (const double exponent : {1.0, 0.6548, 0.5860, 0.5149})
    EXPECT_EQ(tables.proportioned(exponent).in_liquid->simulated().exponent, exponent);
}

/// The exponent depends a little on the temperature.
TEST(ProportionedTables, TheNearestExponentCounts) {
  const ModulusTables tables("");
  EXPECT_EQ(tables.proportioned(0.66).in_liquid, tables.proportioned(0.6548).in_liquid);
  EXPECT_EQ(tables.proportioned(0.58).in_liquid, tables.proportioned(0.5860).in_liquid);
}

/// The ratio of the laws compares cells in one liquid.
TEST(ProportionedTables, LawsOfTheCortexAreComparedInANewtonianLiquid) {
  const ModulusTables tables("");
  const ProportionedTables found = tables.proportioned(0.6548);
  EXPECT_EQ(found.by_current_area->simulated().exponent, 1);
  EXPECT_EQ(found.by_reference_area->simulated().exponent, 1);
}

}  // namespace
}  // namespace rheocyte::proportioned_tables_test

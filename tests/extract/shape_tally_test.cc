// What a recording's events add up to.
#include "extract/shape_tally.h"

#include <gtest/gtest.h>

#include <vector>

namespace rheocyte::shape_tally_test {
namespace {

TEST(ShapeTallyInMemory, EventsOutsideTheGatesAndCutOutlinesHaveNoPartInTheMedianCell) {
  const std::vector<ModulusState> states{ModulusState::valid, ModulusState::gated, ModulusState::too_soft,
                                         ModulusState::cut};
  const std::vector<double> areas{100, 110, 120, 130}, deformations{0.02, 0.03, 0.1, 0.05}, ratios{1.2, 1.3, 1.4, 1.5},
      moduli{1, no_value, no_value, no_value};
  const std::vector<ShapeExcess> excess(states.size(), {no_value, no_value, no_value, no_value});
  JudgedEvents events{excess, ratios, areas, deformations, {}, {}, moduli};
  events.states = states;
  ShapeTally tally;
  tally.take(events);
  EXPECT_EQ(tally.figures().area_um2, (std::vector<double>{100, 120}));
  EXPECT_EQ(tally.figures().inertia_ratio, (std::vector<double>{1.2, 1.4}));
}

}  // namespace
}  // namespace rheocyte::shape_tally_test

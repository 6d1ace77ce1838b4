// The events of a recording as the estimator of populations takes them.
#include "experiment/population_sample.h"

#include <gtest/gtest.h>

#include <cmath>

namespace rheocyte::population_sample_test {
namespace {

/// Cells of one size and asymmetry whose c_2 is spread evenly, more densely where it is small.
PopulationEvents events_of_many_elongations(int count) {
  PopulationEvents events;
  events.conditions.flow = {20, 0.04, 15};
  events.pixel_size_um = 0.34;
  events.has_outlines = true;
  events.least_area_um2 = 0, events.greatest_area_um2 = 1e9;
  events.least_deformation = -1, events.greatest_deformation = 1;
  for (int k = 0; k < count; ++k) {
    const double place = (k + 0.5) / count;
    const std::array<double, seen_measures> seen{115, 0.02, 1.2, 0.06 + 0.08 * place * place, 0.03, 0, 0, 0, 0, 15};
    events.number.push_back(k + 1);
    for (std::size_t m = 0; m < seen.size(); ++m) events.seen[m].push_back(seen[m]);
  }
  return events;
}

/// Over all events those of the groups have the mean 0 and the variance 1: by the middles of their classes the means of
/// the cells would go with them by a slope that is too small, the more so the wider the classes.
TEST(PopulationSample, ElongationsOfGroupsAreTheMeansOfTheirEvents) {
  PopulationMaps maps(StiffnessMeasure::asymmetry);
  for (const int count : {500, 21000}) {  // these in bins
    const PopulationSample made = population_sample(events_of_many_elongations(count), maps, {});
    EXPECT_EQ(made.is_binned, count > 20000);
    double events = 0, mean = 0, squares = 0, by_classes = 0;
    for (const EventGroup& group : made.sample.groups)
      for (const SampleEvent& event : group.events) {
        events += event.count;
        mean += event.count * group.elongation;
        squares += event.count * group.elongation * group.elongation;
      }
    for (const KeptClass& kept : made.sample.kept)
      by_classes += kept.count * (kept.elongation * kept.elongation + kept.elongation_variance);
    EXPECT_EQ(events, count);
    EXPECT_NEAR(mean / events, 0, 1e-9);
    EXPECT_NEAR(squares / events, 1, 1e-9);
    EXPECT_NEAR(by_classes / events, 1, 1e-9);
  }
}

/// The cells differ in c_2 alone, and by their group's they would differ in the other measures as its map says.
TEST(PopulationSample, BinnedEventsAreSeenWithTheElongationOfTheirGroup) {
  PopulationMaps maps(StiffnessMeasure::asymmetry);
  const PopulationSample made = population_sample(events_of_many_elongations(21000), maps, {});
  for (const EventGroup& group : made.sample.groups)
    for (const SampleEvent& event : group.events) {
      // Half a class, 0.005, by slopes of at most 1, and half a bin.
      EXPECT_NEAR(event.log_area, std::log(115), 0.01);
      EXPECT_NEAR(event.measure, 0.03, 0.006);
    }
}

}  // namespace
}  // namespace rheocyte::population_sample_test

// Virtual experiments with cells of the table: bias, coverage and false alarms of the effective modulus and its ratios.
#include "extract/effective_cell.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <vector>

#include "measurement/shape_in_pixels.h"
#include "numeric/quantile.h"
#include "population/comparison.h"
#include "store/build_info.h"

namespace rheocyte::effective_cell_test {
namespace {

constexpr double pixel_um = 0.34, tension_Pa = 190;
const ChannelFlow flow{20, 0.04, 6, 1};

const ProportionedCells& cells() {
  static const ProportionedCells found(
      read_combined_table(std::filesystem::path(data_folder) / combined_file_name("HL-2D-NH-26")));
  return found;
}

ProportionedTables tables() { return {&cells(), &cells(), nullptr}; }

/// Of the table, with this radius and stiffness, under the tension.
CellCoordinates cell_with(double radius_um, double stiffness_kPa) {
  constexpr int halvings = 50;
  const CombinedInterpolation& table = cells().table();
  CellCoordinates cell = table.box().least;
  cell(x_radius) = std::log(radius_um), cell(x_axial) = 1e-3 * tension_Pa / stiffness_kPa;
  double stiffer = table.box().least(x_progress), softer = table.box().greatest(x_progress);
  for (int i = 0; i < halvings; ++i) {
    cell(x_progress) = (stiffer + softer) / 2;
    (table.at(cell).value(log_stiffness_row) > std::log(stiffness_kPa) ? stiffer : softer) = cell(x_progress);
  }
  return cell;
}

double effective_of(double radius_um, double stiffness_kPa) {
  const CellCoordinates cell = cell_with(radius_um, stiffness_kPa);
  return effective_modulus_kPa(cells_at_rest(cells().table().spec()), cell, cells().table().at(cell)).value;
}

struct Sample {
  double stiffness_kPa, spread, level;  ///< the level is that of the recording, of ln S
  int events;
};

/// Each cell in one picture, wherever it lies on the camera.
EventFigures seen_events(const Sample& sample, std::uint64_t seed) {
  EventFigures events;
  for (int i = 0; i < sample.events; ++i) {
    CellRandom random(seed, std::uint64_t(i), Purpose::population);
    const double radius = 6.3 * std::exp(0.06 * random.normal()),
                 stiffness = sample.stiffness_kPa * std::exp(sample.level + sample.spread * random.normal());
    const CombinedState state = cells().table().at(cell_with(radius, stiffness));
    ShapeVector smooth;
    for (int feature = 0; feature < feature_count; ++feature) smooth(feature) = state.value(row_of(feature));
    // An outline of twelve modes is not quite that of the cell: what pixels add to it counts.
    const Eigen::MatrixX2d outline = outline_of(smooth);
    const ShapeVector seen = smooth + features_in_pixels(outline, pixel_um, {random.uniform(), random.uniform()}) -
                             shape_vector(outline_shape(outline));
    events.area_um2.push_back(std::exp(seen(int(ShapeFeature::area_um2))));
    events.deformation.push_back(seen(int(ShapeFeature::deformation)));
    events.inertia_ratio.push_back(1 / std::sqrt(seen(int(ShapeFeature::moment_ratio))));
  }
  return events;
}

EffectiveCell effective_of(const EventFigures& events) { return effective_cell(tables(), events, {flow}, pixel_um); }

TEST(EffectiveCellInMemory, MedianHasNoBiasAndItsErrorIsThatOfItsScatter) {
  constexpr int recordings = 20;
  const double expected = effective_of(6.3, 0.35);
  double sum = 0, squares = 0, tensions = 0, spread = 0;
  for (int k = 0; k < recordings; ++k) {
    const EffectiveCell found = effective_of(seen_events({0.35, 0.2, 0, 200}, 100 + std::uint64_t(k)));
    ASSERT_TRUE(found.is_found());
    const double off = std::log(found.effective_kPa.value / expected);
    sum += off;
    squares += std::pow(off * found.effective_kPa.value / found.effective_kPa.error, 2);
    tensions += found.axial_tension_Pa.value / recordings;
    spread += found.spread / recordings;
  }
  EXPECT_NEAR(sum / recordings, 0, 0.01);
  EXPECT_NEAR(std::sqrt(squares / recordings), 1, 0.3) << "the scatter over the stated error";
  EXPECT_NEAR(tensions, tension_Pa, 0.02 * tension_Pa);
  EXPECT_NEAR(spread, 0.2, 0.03) << "without the noise of pixels";
}

/// Three and three recordings that scatter among themselves by 5 %.
TEST(EffectiveCellInMemory, RatiosOfConditionsAreThoseOfTheCells) {
  constexpr int experiments = 24;
  for (const double ratio : {1.0, 0.7}) {
    int inside = 0, alarms = 0;
    double sum = 0;
    for (int experiment = 0; experiment < experiments; ++experiment) {
      std::array<std::vector<RecordingMean>, 2> means;
      for (std::uint64_t k = 0; k < 6; ++k) {
        const std::uint64_t seed = 1000 + 10 * std::uint64_t(experiment) + k + (ratio < 1 ? 5000 : 0);
        CellRandom level(seed, 0, Purpose::arrival);
        const bool is_treated = k >= 3;
        const EffectiveCell found =
            effective_of(seen_events({is_treated ? 0.36 * ratio : 0.36, 0.2, 0.05 * level.normal(), 80}, seed));
        ASSERT_TRUE(found.is_found());
        means[is_treated].push_back(
            {std::log(found.effective_kPa.value), std::pow(found.effective_kPa.error / found.effective_kPa.value, 2)});
      }
      const ConditionDifference d = unpaired_difference(means[0], means[1], {});
      const double truth = std::log(effective_of(6.3, 0.36 * ratio) / effective_of(6.3, 0.36));
      sum += d.value - truth;
      inside += d.lower <= truth && truth <= d.upper;
      alarms += d.p < 0.05;
    }
    EXPECT_NEAR(sum / experiments, 0, 0.02) << ratio;
    EXPECT_GE(inside, int(0.85 * experiments)) << ratio;
    if (ratio == 1)
      EXPECT_LE(alarms, int(0.15 * experiments));
    else
      EXPECT_GE(alarms, int(0.9 * experiments));
  }
}

TEST(EffectiveCellInMemory, FewEventsHaveNone) {
  EXPECT_EQ(effective_of(seen_events({0.25, 0.2, 0, 19}, 1)).place, EffectivePlace::unknown);
  EXPECT_EQ(effective_cell({}, seen_events({0.25, 0.2, 0, 25}, 1), {flow}, pixel_um).place, EffectivePlace::unknown);
}

/// Outliers as debris makes them.
TEST(EffectiveCellInMemory, OutliersHardlyMoveIt) {
  EventFigures events = seen_events({0.25, 0.2, 0, 400}, 7);
  const double before = effective_of(events).effective_kPa.value;
  for (int i = 0; i < 12; ++i) {
    events.area_um2.push_back(60), events.deformation.push_back(0.3), events.inertia_ratio.push_back(0.4);
  }
  EXPECT_NEAR(effective_of(events).effective_kPa.value, before, 0.03 * before);
}

/// A recording without inertia ratios, whose liquid has the axial tension of others.
TEST(EffectiveCellInMemory, AKnownTensionReplacesInertiaRatios) {
  const EventFigures whole = seen_events({0.3, 0.2, 0, 400}, 11);
  const EffectiveCell by_shapes = effective_of(whole);
  EventFigures events = whole;
  events.has_ratios = false;
  std::ranges::fill(events.inertia_ratio, no_value);
  EXPECT_EQ(effective_cell(tables(), events, {flow}, pixel_um).place, EffectivePlace::unknown);
  const AxialTension known{by_shapes.axial_tension_Pa.value, 0};
  const EffectiveCell by_tension = effective_cell(tables(), events, {flow}, pixel_um, known);
  ASSERT_TRUE(by_tension.is_found());
  EXPECT_FALSE(by_tension.is_by_ratios);
  EXPECT_NEAR(by_tension.effective_kPa.value / by_shapes.effective_kPa.value, 1, 2e-3);
  EXPECT_NEAR(by_tension.axial_tension_Pa.value, known.value_Pa, 0.01 * known.value_Pa);
  // The error of the tension is part of that of the modulus.
  const auto under = [&](double over_known, double relative_error) {
    const AxialTension tension{over_known * known.value_Pa, relative_error * known.value_Pa};
    return effective_cell(tables(), events, {flow}, pixel_um, tension).effective_kPa;
  };
  const double change = (under(1.03, 0).value - under(0.97, 0).value) / 0.06 * 0.1;
  EXPECT_NEAR(std::hypot(by_tension.effective_kPa.error, change) / under(1, 0.1).error, 1,
              0.15);  // corrections for pixels and section move with the cell
}

/// A tension that contradicts the inertia ratios, of which neither is a compromise.
TEST(EffectiveCellInMemory, AKnownTensionComesBeforeTheInertiaRatios) {
  const EventFigures whole = seen_events({0.3, 0.2, 0, 200}, 11);
  EventFigures without = whole;
  without.has_ratios = false;
  const AxialTension other{250, 0};
  const EffectiveCell cell = effective_cell(tables(), whole, {flow}, pixel_um, other), by_shapes = effective_of(whole);
  EXPECT_EQ(cell.effective_kPa.value, effective_cell(tables(), without, {flow}, pixel_um, other).effective_kPa.value);
  EXPECT_EQ(cell.by_ratios_kPa, by_shapes.effective_kPa.value);
  EXPECT_EQ(cell.by_ratios_tension_Pa, by_shapes.axial_tension_Pa.value);
}

/// As in a table of binned events.
TEST(EffectiveCellInMemory, EventsOfOneSizeHaveAModulus) {
  EventFigures events = seen_events({0.3, 0.2, 0, 200}, 11);
  const double expected = effective_of(events).effective_kPa.value;
  std::ranges::fill(events.area_um2, CountedSample<double>(events.area_um2).quantile(0.5));
  const EffectiveCell cell = effective_of(events);
  ASSERT_EQ(cell.place, EffectivePlace::inside) << events.area_um2.front();
  EXPECT_NEAR(cell.effective_kPa.value, expected, 1e-3 * expected);
}

}  // namespace
}  // namespace rheocyte::effective_cell_test

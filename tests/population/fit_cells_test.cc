// The distribution of cells that is found, against the one that was drawn.
#include "population/fit_cells.h"

#include <gtest/gtest.h>

#include <cmath>

#include "invented_map.h"

namespace rheocyte::fit_cells_test {
namespace {

using test::drawn_sample;
using test::usual_cells;
using test::whole_map;

FitSettings two_threads() {
  FitSettings settings;
  settings.threads = 2;
  settings.level = 0.9;
  return settings;
}

/// Of many samples of one population.
struct Trials {
  int count = 0;
  ParameterVector sum = ParameterVector::Zero(), squares = ParameterVector::Zero(), covered = ParameterVector::Zero();

  Trials(const CellDistribution& cells, int events, int trials, const SampleGates& gates)
      : Trials(cells, trials, [&](std::uint64_t seed) { return drawn_sample(cells, events, seed, gates); }) {}

  template <class Draw>
  Trials(const CellDistribution& cells, int trials, const Draw& draw) {
    const ParameterVector truth = cells.parameters();
    for (int k = 0; k < trials; ++k) {
      const FittedCells fitted = fit_cells(draw(std::uint64_t(100 + k)), two_threads());
      EXPECT_EQ(fitted.state, FitState::fitted);
      ++count;
      for (int i = 0; i < population_parameters; ++i) {
        const double off = fitted.cells.parameters()(i) - truth(i);
        sum(i) += off;
        squares(i) += off * off;
        const auto& interval = fitted.intervals[std::size_t(i)];
        covered(i) += interval.lower < truth(i) && truth(i) < interval.upper;
      }
    }
  }
  double bias(int i) const { return sum(i) / count; }
  double error(int i) const { return std::sqrt((squares(i) / count - bias(i) * bias(i)) / count); }
  double cover(int i) const { return covered(i) / count; }
};

TEST(FitCells, MeansAndSpreadsComeBackAndIntervalsCover) {
  constexpr int trials = 40;
  const Trials t(usual_cells(), 400, trials, whole_map());
  for (int i = 0; i < population_parameters; ++i) {
    // Four standard errors of the trials; the spreads of 400 cells have a bias of about 1 / 800 of their own.
    EXPECT_NEAR(t.bias(i), 0, 4 * t.error(i) + (i > 1 ? 0.003 : 0)) << i;
    // 40 trials of 90 %: standard deviation 4.7 %.
    EXPECT_NEAR(t.cover(i), 0.9, 0.16) << i;
  }
}

TEST(FitCells, GatesThatKeepHalfTheCellsLeaveNoBias) {
  SampleGates gates = whole_map();
  gates.least_log_area = 2 * usual_cells().mean_log_radius + std::log(std::numbers::pi) + 0.005;
  const Trials t(usual_cells(), 400, 30, gates);
  for (int i = 0; i < 4; ++i) EXPECT_NEAR(t.bias(i), 0, 4 * t.error(i) + (i > 1 ? 0.006 : 0)) << i;
  const FittedCells fitted = fit_cells(drawn_sample(usual_cells(), 400, 1, gates), two_threads());
  EXPECT_NEAR(fitted.kept_fraction, 0.5, 0.15);
}

/// Long cells are softer and larger, and many of the soft ones do not pass: what is left of these is no sample of all.
TEST(FitCells, CellsWhoseMeanGoesWithTheirElongationAreFoundAlsoThroughGates) {
  const CellLaw law{usual_cells(), 0.03, -0.15};
  constexpr double variance = 0.8198;  // of the elongations that drawn_long_sample has
  const CellDistribution all = law.population(0, variance);
  SampleGates gates = whole_map();
  gates.greatest_measure = 0.042;  // a third of the cells is beyond it
  const Trials t(all, 30, [&](std::uint64_t seed) { return test::drawn_long_sample(law, 500, seed, gates); });
  for (int i = 0; i < population_parameters; ++i) {
    EXPECT_NEAR(t.bias(i), 0, 4 * t.error(i) + (i > 1 ? 0.006 : 0)) << i;
    EXPECT_NEAR(t.cover(i), 0.9, 0.19) << i;
  }
}

TEST(FitCells, StiffCellsThatLookRounderThanASphereAreNotLost) {
  CellDistribution cells = usual_cells();
  cells.mean_log_modulus += 1.4;  // measures of 0.009, noise 0.003
  const Trials t(cells, 400, 30, whole_map());
  EXPECT_NEAR(t.bias(1), 0, 4 * t.error(1));
  EXPECT_LT(t.error(1) * std::sqrt(30.0), 0.04);
  EXPECT_NEAR(t.cover(1), 0.9, 0.18);
}

TEST(FitCells, CellsBelowTheNoiseHaveALowerLimitAlone) {
  CellDistribution cells = usual_cells();
  cells.mean_log_modulus += 4;  // measures of 0.0007
  const FittedCells fitted = fit_cells(drawn_sample(cells, 300, 2, whole_map()), two_threads());
  ASSERT_EQ(fitted.state, FitState::too_stiff);
  ASSERT_TRUE(fitted.least_log_modulus);
  EXPECT_GT(*fitted.least_log_modulus, cells.mean_log_modulus - 1);
  EXPECT_LT(*fitted.least_log_modulus, cells.mean_log_modulus);
}

TEST(FitCells, ASpreadThatIsLostInTheNoiseIsSaidToBeAtItsBound) {
  CellDistribution cells = usual_cells();
  cells.modulus_spread = 0.001;
  int at_bound = 0;
  for (std::uint64_t seed = 0; seed < 6; ++seed) {
    const FittedCells fitted = fit_cells(drawn_sample(cells, 200, 40 + seed, whole_map()), two_threads());
    ASSERT_EQ(fitted.state, FitState::fitted);
    constexpr int spread = number_of(PopulationParameter::log_modulus_spread);
    if (!fitted.at_bound[spread]) continue;
    ++at_bound;
    EXPECT_TRUE(std::isnan(fitted.intervals[spread].lower) && std::isnan(fitted.intervals[spread].upper));
    EXPECT_GT(fitted.standard_error(PopulationParameter::mean_log_modulus), 0);
  }
  EXPECT_GE(at_bound, 1) << "chance alone gives half of them a spread";
}

TEST(FitCells, ShrunkenValuesHaveTheSpreadOfWhatIsKnownAndTheMeanOfThePopulation) {
  FitSettings settings = two_threads();
  settings.with_shrunken = true;
  CellDistribution cells = usual_cells();
  cells.mean_log_modulus += 1;
  const Sample sample = drawn_sample(cells, 1000, 9, whole_map());
  const FittedCells fitted = fit_cells(sample, settings);
  ASSERT_EQ(fitted.shrunken.size(), 1000U);
  double sum = 0, squares = 0, variances = 0;
  for (const ShrunkenCell& cell : fitted.shrunken) {
    sum += cell.log_modulus;
    squares += cell.log_modulus * cell.log_modulus;
    variances += cell.modulus_deviation * cell.modulus_deviation;
  }
  const double mean = sum / 1000, spread = squares / 1000 - mean * mean;
  // At the maximum of the likelihood both hold exactly, but for gates and nodes.
  EXPECT_NEAR(mean, fitted.cells.mean_log_modulus, 1e-3);
  EXPECT_NEAR(spread + variances / 1000, std::pow(fitted.cells.modulus_spread, 2), 1e-3);
}

TEST(FitCells, TheSameSampleGivesTheSameNumbersForAnyNumberOfThreads) {
  const Sample sample = drawn_sample(usual_cells(), 500, 21, whole_map());
  FitSettings settings = two_threads();
  const FittedCells two = fit_cells(sample, settings);
  settings.threads = 5;
  const FittedCells five = fit_cells(sample, settings);
  EXPECT_EQ(two.cells.parameters(), five.cells.parameters());
  EXPECT_EQ(two.covariance, five.covariance);
}

TEST(EventError, IsThatOfBothMeasures) {
  const test::InventedMap map;
  // With a constant radius ln E goes as the inverse measure: 0.003 of 0.0368, and the area's error adds little.
  EXPECT_NEAR(event_error(map, std::log(6.0), 0), 0.003 * 1.037 / 0.0368, 4e-3);
}

}  // namespace
}  // namespace rheocyte::fit_cells_test

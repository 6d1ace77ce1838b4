// Likelihood of events under a distribution of cells, and its slopes.
#include "population/likelihood.h"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>
#include <vector>

#include "invented_map.h"
#include "population/event_bins.h"
#include "population/fit_cells.h"

namespace rheocyte::likelihood_test {
namespace {

using test::drawn_long_sample;
using test::drawn_sample;
using test::InventedMap;
using test::usual_cells;
using test::whole_map;

double density_of_cells(const CellDistribution& c, double u, double e) {
  const double zu = (u - c.mean_log_radius) / c.radius_spread, ze = (e - c.mean_log_modulus) / c.modulus_spread;
  const double r2 = 1 - c.correlation * c.correlation;
  return std::exp(-0.5 * (zu * zu - 2 * c.correlation * zu * ze + ze * ze) / r2) /
         (2 * std::numbers::pi * c.radius_spread * c.modulus_spread * std::sqrt(r2));
}

double density_of_noise(const MapPoint& p, double log_area, double measure) {
  const double a = log_area - p.log_area, b = measure - p.measure;
  const double det = p.area_variance * p.measure_variance - p.covariance * p.covariance;
  const double form = (p.measure_variance * a * a - 2 * p.covariance * a * b + p.area_variance * b * b) / det;
  return std::exp(-0.5 * form) / (2 * std::numbers::pi * std::sqrt(det));
}

/// The double integral over all cells, on a grid that is finer than the noise.
double brute_force(const ForwardMap& map, const SampleEvent& event, const CellDistribution& cells) {
  const double middle = 0.5 * (event.log_area - std::log(std::numbers::pi)), du = 0.0002, dx = 0.005;
  double sum = 0;
  for (double u = middle - 0.06; u < middle + 0.03; u += du) {
    const double end = map.soft_end(u).log_modulus;
    for (double x = dx / 2; x < 6; x += dx)
      sum += density_of_cells(cells, u, end + x + event.log_viscosity) *
             density_of_noise(map.at(u, x), event.log_area, event.measure);
  }
  return sum * du * dx;
}

TEST(EventLikelihood, IsTheIntegralOverAllCells) {
  const InventedMap map;
  // The map is straightened within the noise of the area, 0.2 % of the radius: 1e-3 of the likelihood. Of cells that
  // are much stiffer than the population's the measure lies four standard deviations off, and with it, by their
  // correlation, the area one: the noise there, 0.25 % smaller, counts for 4^2 times as much.
  const std::vector<std::pair<SampleEvent, double>> cases{
      {{4.75, 0.04, 0.69}, 3e-3}, {{4.9, 0.07, 0.6}, 3e-3}, {{4.6, 0.006, 0.69}, 0.06}, {{4.7, -0.003}, 0.06}};
  for (const auto& [event, tolerance] : cases) {
    for (const CellDistribution& cells : {usual_cells(), CellDistribution{1.75, 0.5, 0.2, 0.4, -0.5}}) {
      const EventNodes nodes(map, event, cells, {0, 0});
      const double expected = std::log(brute_force(map, event, cells));
      EXPECT_NEAR(nodes.answer(cells, false).log_likelihood, expected, tolerance) << event.measure;
    }
  }
}

TEST(EventLikelihood, TwentyFourNodesAreAsManyAsNeeded) {
  const InventedMap map;
  for (const SampleEvent& event : {SampleEvent{4.75, 0.04, 0.69}, {4.6, 0.004, 0.69}, {4.6, -0.004, 0.69}}) {
    const double with_24 =
                     EventNodes(map, event, usual_cells(), {0, 0}, 24).answer(usual_cells(), false).log_likelihood,
                 with_96 =
                     EventNodes(map, event, usual_cells(), {0, 0}, 96).answer(usual_cells(), false).log_likelihood;
    EXPECT_NEAR(with_24, with_96, 1e-6) << event.measure;
  }
}

TEST(PopulationLikelihood, TheScoreIsItsSlopeAlsoWithGates) {
  for (const bool is_cut : {false, true}) {
    SampleGates gates = whole_map();
    if (is_cut) gates.greatest_measure = 0.037, gates.least_log_area = 4.7;
    const Sample sample = drawn_long_sample({usual_cells(), 0.02, -0.1}, 60, 3, gates);
    PopulationLikelihood likelihood(sample, 1);
    const LawVector q = CellLaw{{1.8, 0.75, 0.09, 0.23, 0.2}, 0.03, -0.1}.parameters();
    likelihood.place(CellLaw::of(q));
    const LawVector score = likelihood.at(q).score;
    for (int k = 0; k < law_parameters; ++k) {
      LawVector step = LawVector::Zero();
      step(k) = 1e-4;
      // Taylor: without the slope the difference is of first order, with it of the third.
      const double slope = (likelihood.log_likelihood(q + step) - likelihood.log_likelihood(q - step)) / 2e-4;
      EXPECT_NEAR(score(k), slope, 1e-4 * std::max(1.0, std::abs(slope))) << k << " " << is_cut;
    }
  }
}

TEST(KeptFraction, IsTheFractionOfDrawnEventsThatPass) {
  const auto map = std::make_shared<InventedMap>();
  SampleGates gates = whole_map();
  gates.greatest_measure = 0.04;
  gates.least_log_area = 4.65;
  gates.least_measure = 0.02;
  const CellDistribution cells = usual_cells();
  const KeptFraction kept({map, gates, 0.69, 1});
  constexpr int draws = 200000;
  int passed = 0;
  for (int k = 0; k < draws; ++k) {
    CellRandom random(7, std::uint64_t(k), Purpose::population);
    DrawnCell cell = drawn_cell(cells, random);
    cell.log_modulus -= 0.69;
    const SeenValues seen = seen_values(*map, cell, random);
    passed += gates.pass(seen.log_area, seen.measure);
  }
  const double fraction = double(passed) / draws;
  // Four standard errors of the draws.
  EXPECT_NEAR(kept.answer(cells, false).fraction, fraction, 4 * std::sqrt(fraction * (1 - fraction) / draws));
}

TEST(PopulationLikelihood, AllOfItIsTheSameForAnyNumberOfThreads) {
  const Sample sample = drawn_sample(usual_cells(), 700, 5, whole_map());
  PopulationLikelihood one(sample, 1), three(sample, 3);
  one.place({usual_cells()});
  three.place({usual_cells()});
  const LawVector q = CellLaw{usual_cells()}.parameters();
  const auto a = one.at(q), b = three.at(q);
  EXPECT_EQ(a.log_likelihood, b.log_likelihood);
  EXPECT_EQ(a.score, b.score);
  EXPECT_EQ(a.products, b.products);
}

TEST(EventBins, ChangeAnEstimateByLessThanATenthOfItsError) {
  Sample sample = drawn_sample(usual_cells(), 20000, 11, whole_map());
  FitSettings settings;
  settings.threads = 2;
  const FittedCells exact = fit_cells(sample, settings);
  const BinWidths widths{0.008, 0.0015, 0.01};
  auto& events = sample.groups[0].events;
  events = binned(events, widths);
  sample.added_area_variance = widths.log_area * widths.log_area / 12;
  sample.added_measure_variance = widths.measure * widths.measure / 12;
  EXPECT_LT(sample.bins(), 8000U);
  EXPECT_EQ(sample.events(), 20000);
  const FittedCells coarse = fit_cells(sample, settings);
  for (int k = 0; k < population_parameters; ++k)
    EXPECT_NEAR(coarse.cells.parameters()(k), exact.cells.parameters()(k), 0.1 * std::sqrt(exact.covariance(k, k)))
        << k;
}

}  // namespace
}  // namespace rheocyte::likelihood_test

// What is said of cells beside the axis.
#include "extract/beside_axis.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "extract/turning_law.h"

namespace rheocyte::beside_axis_test {
namespace {

const ChannelFlow flow{.width_um = 20, .rate_ul_s = 0.04, .viscosity_mPas = 6, .exponent = 1};

/// Cells that move along +x, as those of HL60 scatter: 0.4 um beside the axis at 13.4 um in the middle of 60 um.
struct Experiment {
  double sine_slope = -0.0475, flank_slope = 0, flank_growth_per_um = 0, spread_um = 0.4, centring_per_um = 0,
         ratio = 1.6;
  int events = 1000;
};

struct Columns {
  std::vector<double> x, y, sine, flank, area, ratio;
  PlacedOutlines placed() const { return {x, y, sine, flank, area, ratio}; }
};

Columns drawn(const Experiment& e, std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> place(0, 60);
  Columns c;
  for (int i = 0; i < e.events; ++i) {
    const double x = place(random), y = e.spread_um * std::exp(e.centring_per_um * (x - 30)) * normal(random);
    const bool is_stray = i % 30 == 11;
    c.x.push_back(x);
    c.y.push_back(13.4 + y);
    c.sine.push_back(e.sine_slope * y + 0.013 * normal(random) + (is_stray ? 0.2 : 0));
    c.flank.push_back((e.flank_slope + e.flank_growth_per_um * (x - 30)) * y + 0.04 * normal(random));
    c.area.push_back(140);
    c.ratio.push_back(e.ratio + 0.05 * normal(random));
  }
  return c;
}

BesideAxis found(const Experiment& e, std::uint64_t seed = 1) {
  std::mt19937_64 random(seed);
  return beside_axis(drawn(e, random).placed(), 1, flow);
}

TEST(BesideAxis, SlopesAndCentringOfSimulatedExperimentsAreWithoutBiasAndTheirErrorsHold) {
  // 95 % of the intervals of two errors; 400 experiments resolve 1.1 %.
  constexpr int experiments = 400;
  const Experiment truth{.flank_slope = 0.03, .centring_per_um = -0.004, .events = 200};
  double sine = 0, flank = 0, centring = 0, axis = 0;
  int sine_held = 0, flank_held = 0, centring_held = 0;
  for (int i = 0; i < experiments; ++i) {
    const BesideAxis r = found(truth, 100 + std::uint64_t(i));
    sine += r.sine_slope.value / experiments;
    flank += r.flank_slope.value / experiments;
    centring += r.centring.value / experiments;
    axis += r.axis_um / experiments;
    const auto holds = [](const Estimate& e, double value) { return std::abs(e.value - value) < 2 * e.error; };
    sine_held += holds(r.sine_slope, truth.sine_slope);
    flank_held += holds(r.flank_slope, truth.flank_slope);
    centring_held += holds(r.centring, truth.centring_per_um);
  }
  EXPECT_NEAR(sine / truth.sine_slope, 1, 0.01);
  EXPECT_NEAR(flank / truth.flank_slope, 1, 0.05);        // three standard errors of the mean
  EXPECT_NEAR(centring / truth.centring_per_um, 1, 0.1);  // the same tolerance
  EXPECT_NEAR(axis, 13.4, 0.01);
  for (const int held : {sine_held, flank_held, centring_held}) EXPECT_NEAR(held / double(experiments), 0.95, 0.035);
}

TEST(BesideAxis, FlanksThatStayParallelMeanThatTheFlowRenewsTheElongation) {
  const BesideAxis r = found({});
  EXPECT_EQ(r.turn(), BesideAxis::Turn::parallel);
  EXPECT_NE(r.turn_text().find("renewed by the flow"), std::string::npos) << r.turn_text();
  EXPECT_NEAR(r.way_um, 40, 3);
}

TEST(BesideAxis, AShapeThatCellsBringAlongIsToldByTheTurnThatItTakes) {
  // At the start parallel to the flow, then turned as the material turns.
  const double growth = found({}).stored_slope / found({}).way_um;
  const BesideAxis r = found({.sine_slope = 0.05, .flank_slope = 30 * growth, .flank_growth_per_um = growth});
  EXPECT_EQ(r.turn(), BesideAxis::Turn::stored);
  EXPECT_NEAR(r.flank_change().value / r.stored_slope, 1, 0.1);
  EXPECT_NE(r.turn_text().find("turned as a stored shape would be"), std::string::npos) << r.turn_text();
}

TEST(BesideAxis, NosesThatPointToTheAxisAreThoseOfElasticCells) {
  const BesideAxis r = found({.sine_slope = -0.117, .flank_slope = -0.12});
  EXPECT_EQ(r.turn(), BesideAxis::Turn::towards_axis) << r.stored_slope;
  EXPECT_NE(r.turn_text().find("point their noses to it"), std::string::npos) << r.turn_text();
}

TEST(BesideAxis, FewEventsDecideNothing) {
  EXPECT_EQ(found({.events = 40}).turn(), BesideAxis::Turn::undecided);
  EXPECT_NE(found({.events = 40}).turn_text().find("is unknown"), std::string::npos);
}

TEST(BesideAxis, OnTheAxisWithFewerThan15EventsOrWithoutElongationNothingIsSaid) {
  for (const Experiment& silent : {Experiment{.spread_um = 0.15}, Experiment{.events = 14}, Experiment{.ratio = 1}}) {
    EXPECT_EQ(found(silent).turn(), BesideAxis::Turn::unknown);
    EXPECT_EQ(found(silent).turn_text(), "");
  }
  EXPECT_TRUE(std::isnan(found({.spread_um = 0.15}).sine_slope.value));
  EXPECT_EQ(beside_axis({}, 1, flow).turn_text() + beside_axis({}, 1, flow).centring_text(), "");
}

TEST(BesideAxis, WithoutAFlowRateOrADirectionThereIsNoPrediction) {
  std::mt19937_64 random(1);
  const Columns columns = drawn({}, random);
  const BesideAxis without_rate = beside_axis(columns.placed(), 1, {.width_um = 20}),
                   without_direction = beside_axis(columns.placed(), 0, flow);
  for (const BesideAxis& r : {without_rate, without_direction}) {
    EXPECT_TRUE(std::isnan(r.stored_slope));
    EXPECT_EQ(r.turn(), BesideAxis::Turn::unknown);
    EXPECT_NEAR(r.sine_slope.value, -0.0475, 0.005);
  }
  EXPECT_TRUE(std::isfinite(without_rate.centring.value));
}

TEST(BesideAxis, CellsThatMoveTheOtherWayCentreDownstream) {
  std::mt19937_64 random(1);
  const Columns columns = drawn({.centring_per_um = 0.006}, random);
  EXPECT_FALSE(beside_axis(columns.placed(), 1, flow).is_centring());
  const BesideAxis r = beside_axis(columns.placed(), -1, flow);
  EXPECT_TRUE(r.is_centring());
  EXPECT_NE(r.centring_text().find("still approach the axis"), std::string::npos) << r.centring_text();
}

TEST(TurningLaw, IsThatOfTheSolverForCellsBesideTheAxis) {
  // States of the square of 20 um, 0.04 ul/s, 6 mPa s, E 20 kPa, 0.5 um beside the axis (`rheocyte solve` with
  // cell.offset_um and numerics.accuracy_of = "motion"): rotation_rate_per_s per um, cell_velocity_m_per_s; the same
  // with the exponents 0.6 and 0.8.
  struct State {
    double exponent, radius_um, rate_per_um, velocity_m_per_s;
  };
  for (const State& s : {State{1, 3, 1759, 0.1986}, State{1, 6, 1645, 0.1687}, State{1, 8, 1610, 0.1424},
                         State{0.8, 6, 1277, 0.1666}, State{0.6, 4.5, 757, 0.1740}, State{0.6, 6, 781, 0.1632}}) {
    const ChannelFlow liquid{.width_um = 20, .rate_ul_s = 0.04, .viscosity_mPas = 6, .exponent = s.exponent};
    EXPECT_NEAR(turning_rate_per_um(s.radius_um, liquid) / s.rate_per_um, 1, 0.08);
    EXPECT_NEAR(cell_velocity_um_per_s(s.radius_um, liquid) / (1e6 * s.velocity_m_per_s), 1, 0.01);
  }
}

}  // namespace
}  // namespace rheocyte::beside_axis_test

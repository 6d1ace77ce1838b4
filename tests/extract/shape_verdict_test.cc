// What is said about the shapes of a recording.
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "extract/common_errors.h"
#include "extract/recommendation.h"
#include "extract/shape_tally.h"
#include "extract/shape_words.h"

namespace rheocyte::shape_verdict_test {
namespace {

/// Events that scatter by +-0.01 about an excess, along 60 um; `growth` of the deformation over them.
ShapeVerdict verdict_of(double excess, double growth = 0, double length_um = 60, int events = 200) {
  std::vector<ShapeExcess> excesses;
  std::vector<double> ratio, deformation, x;
  for (int i = 0; i < events; ++i) {
    const double scatter = 0.01 * std::sin(2.4 * i), place = double(i) / events;
    excesses.push_back({1, excess + scatter, 0.01, 0.3});
    ratio.push_back(1 + excess + scatter);
    deformation.push_back(0.02 + growth * place + 0.001 * std::sin(1.7 * i));
    x.push_back(100 + length_um * place);
  }
  ShapeTally tally;
  tally.take({excesses, ratio, {}, deformation, {}, x, {}, {}, {}});
  return tally.verdict();
}

TEST(ShapeVerdict, CellsRounderThanTheTablesAreNotThoseOfTheModel) {
  EXPECT_EQ(verdict_of(-0.005).fit(), ShapeVerdict::Fit::model);
  EXPECT_EQ(verdict_of(-0.035).fit(), ShapeVerdict::Fit::doubtful);
  ShapeVerdict v = verdict_of(-0.086);
  v.model = "linear solids in the tube";
  EXPECT_EQ(v.fit(), ShapeVerdict::Fit::rounder);
  EXPECT_NE(v.text().find("rounder than linear solids in the tube and than"), std::string::npos) << v.text();
  EXPECT_NE(recommendation(v).way, RecommendedWay::deformation);
  v.other = {"HE-3D-26", "neo-Hookean solids in the square channel", {0.002, 0.001}, 1.02, 0.95};
  EXPECT_EQ(v.fit(), ShapeVerdict::Fit::other_table);
  EXPECT_NE(v.text().find("5.0 % too low, take the table HE-3D-26"), std::string::npos) << v.text();
}

TEST(ShapeVerdict, NamesTheThreeCases) {
  EXPECT_EQ(verdict_of(0.005).fit(), ShapeVerdict::Fit::model);
  EXPECT_NE(verdict_of(0.005).text().find("the shapes are those of the model"), std::string::npos);
  EXPECT_EQ(verdict_of(0.035).fit(), ShapeVerdict::Fit::doubtful);
  EXPECT_EQ(verdict_of(0.2).fit(), ShapeVerdict::Fit::elongated);
}

TEST(ShapeVerdict, TheModelIsNamedAndNoFactorIs) {
  ShapeVerdict v = verdict_of(0.2);
  v.model = "neo-Hookean solids in the square channel";
  v.modulus_ratio = 0.4;
  EXPECT_NE(v.text().find("elongated along the flow more than neo-Hookean solids in the square channel and than"),
            std::string::npos)
      << v.text();
  EXPECT_NE(v.text().find("from deformation are too low, see"), std::string::npos) << v.text();
  EXPECT_EQ(v.text().find("factor"), std::string::npos) << v.text();
  v.modulus_ratio = 1.2;
  EXPECT_NE(v.text().find("not below those of elongated cells: are pixel size"), std::string::npos) << v.text();
  v.excess.value = 0.005;
  EXPECT_NE(v.text().find("those of the model, neo-Hookean solids in the square channel ("), std::string::npos);
}

TEST(ShapeVerdict, CellsOfAnotherTableAreNotAccused) {
  ShapeVerdict v = verdict_of(0.06);
  v.model = "neo-Hookean solids in the square channel";
  v.other = {"LE-2D-26", "linear solids in the tube", {0.002, 0.001}, 1.04, 1.048};
  EXPECT_EQ(v.fit(), ShapeVerdict::Fit::other_table);
  EXPECT_NE(v.text().find("but those of linear solids in the tube"), std::string::npos) << v.text();
  EXPECT_NE(v.text().find("given here are 4.8 % too high, take the table LE-2D-26."), std::string::npos) << v.text();
  v.excess.value = 0.005;
  EXPECT_EQ(v.fit(), ShapeVerdict::Fit::model) << "the table that is used comes first";
}

/// Sixty cells with moduli as of elongated ones, whose c_4 and c_5 are beyond those of solids by so much.
ShapeVerdict elongated_verdict(double mode_4, double mode_5, double excess = 0.2) {
  constexpr std::size_t count = 60;
  const std::vector<ShapeExcess> excesses(count, {1, excess, 0.01, 0.3});
  const std::vector<double> ratio(count, 1 + excess), deformation(count, 0.02), area(count, 100), modulus(count, 1),
      elongated(count, 2.5), error(count, 0.1), elongation(count, 1.2), tension(count, 250), third(count, 0.05),
      fourth(count, mode_4), fifth(count, mode_5);
  const std::vector<ModulusState> states(count, ModulusState::valid);
  ShapeTally tally;
  tally.take({.excess = excesses,
              .inertia_ratio = ratio,
              .area_um2 = area,
              .deformation = deformation,
              .mode_3 = third,
              .x_um = {},
              .modulus_kPa = modulus,
              .elongation = {elongated, error, elongation, error, tension, error},
              .mode_4_excess = fourth,
              .mode_5_excess = fifth,
              .states = states,
              .elongated_states = states,
              .cells = {}});
  ShapeVerdict verdict = tally.verdict();
  verdict.has_elongated_table = true;
  verdict.by_deformation.common_error = 0.03;
  verdict.by_elongation.common_error = 0.02;
  return verdict;
}

/// Of so many events with scattered moduli about a value, and others beside them.
CensoredMedian median_of_events(int events, double about, CensoredCounts beside = {}) {
  std::vector<double> moduli;
  for (int i = 0; i < events; ++i) moduli.push_back(about * (1 + 0.25 * std::sin(2.4 * i)));
  return censored_median(moduli, beside);
}

std::string text_of(const ShapeVerdict& v) { return recommendation_text(recommendation(v), v); }

TEST(Recommendation, CellsOfAnotherTableHaveAModulusAndNoTension) {
  ShapeVerdict v = elongated_verdict(0.002, -0.003);
  v.other = {"LE-2D-26", "linear solids in the tube", {0.002, 0.001}, 1.04, 1.048};
  ASSERT_EQ(v.fit(), ShapeVerdict::Fit::other_table);
  const Recommendation r = recommendation(v);
  EXPECT_EQ(r.way, RecommendedWay::elongated);
  EXPECT_EQ(code_of(r.reason), "other-table");
  EXPECT_GT(r.kPa.common_error, common_error_of_other_shapes * 2.5);
  EXPECT_NE(text_of(v).find("the cells are linear solids in the tube"), std::string::npos) << text_of(v);
  EXPECT_EQ(text_of(v).find("tension"), std::string::npos) << text_of(v);
}

TEST(ShapeVerdict, ElongationAndTensionAreReportedWithBothErrorsAsTheModulusIs) {
  ShapeVerdict v = elongated_verdict(0.002, -0.003);
  v.elongation.common_error = 0.005;
  v.axial_tension_Pa.common_error = 10;
  const std::string line = shape_lines(v).at(2);
  EXPECT_NE(line.find("elongation 1.2 +- 0 +- 0.005, axial tension 250 +- 0 +- 10 Pa"), std::string::npos) << line;
  EXPECT_NE(text_of(v).find("An axial tension of 250 +- 0 +- 10 Pa"), std::string::npos) << text_of(v);
}

TEST(Recommendation, ElongatedCellsHaveTheModulusOfTheirTableAndBothCausesAreNamed) {
  const ShapeVerdict v = elongated_verdict(0.002, -0.003);
  EXPECT_NEAR(v.modulus_ratio, 0.4, 1e-6);  // kept in single precision
  EXPECT_EQ(v.with_elongation, 60u);
  EXPECT_NEAR(v.axial_tension_Pa.value, 250, 1e-3);
  const Recommendation r = recommendation(v);
  EXPECT_EQ(r.way, RecommendedWay::elongated);
  EXPECT_EQ(r.reason, RecommendationReason::elongated);
  EXPECT_EQ(r.kPa.value, 2.5);
  EXPECT_GE(r.kPa.common_error, error_of_height * 2.5) << "what 1 um off the axis in height does";
  const auto lines = shape_lines(v);
  ASSERT_FALSE(lines.empty());
  EXPECT_NE(lines.back().find("report E = 2.5 +- 0 +- 0.17 kPa (median"), std::string::npos) << lines.back();
  EXPECT_NE(lines.back().find("tension of 250 +- 0 Pa explains it; so do cells off the axis in height"),
            std::string::npos)
      << lines.back();
}

TEST(Recommendation, MoreEventsMakeTheErrorByScatterSmallerAndNotWhatTheyHaveInCommon) {
  const auto recommended = [](int events) {
    ShapeVerdict v = elongated_verdict(0, 0);
    v.by_elongation.median_kPa = median_of_events(events, 2);
    return recommendation(v).kPa;
  };
  const Median few = recommended(100), many = recommended(10000);
  // Quartiles of sin lie at +-0.7071.
  EXPECT_NEAR(many.error, 1.25 * 0.5 * 0.7071 / 0.6745 / 100, 1e-4);
  EXPECT_NEAR(few.error / many.error, 10, 0.5);
  EXPECT_NEAR(few.common_error, many.common_error, 1e-2);
}

TEST(Recommendation, OutlinesComeFirstWhereTheyGiveNearlyAllEventsAModulus) {
  ShapeVerdict v = elongated_verdict(0, 0, 0.005);
  Recommendation r = recommendation(v);
  EXPECT_EQ(code_of(r.reason), "outlines");
  EXPECT_NEAR(r.kPa.common_error, 0.02 * 2.5, 1e-9);
  EXPECT_NE(text_of(v).find("area and deformation give 1 kPa, 60 % less"), std::string::npos) << text_of(v);
  v.by_elongation.median_kPa.value = 1.04;
  EXPECT_EQ(text_of(v).find("area and deformation give"), std::string::npos) << "within the errors: " << text_of(v);
  v.by_elongation.median_kPa = median_of_events(50, 2.5, {.above = 10});
  r = recommendation(v);
  EXPECT_EQ(r.way, RecommendedWay::deformation) << "83 % of the events have a modulus from the outlines, all by d";
  EXPECT_EQ(r.kPa.value, 1);
  EXPECT_NEAR(r.kPa.common_error, 0.03, 1e-9);
  v.by_deformation.median_kPa = median_of_events(45, 1, {.above = 15});
  EXPECT_EQ(recommendation(v).way, RecommendedWay::elongated) << "more by the outlines than by d";
}

TEST(Recommendation, WithoutOutlinesTheModulusIsNamedAsThatOfSolids) {
  ShapeVerdict v = elongated_verdict(0, 0, 0.005);
  v.elongated_by = ElongatedBy::inertia;
  EXPECT_EQ(recommendation(v).way, RecommendedWay::deformation) << "of which the inertia ratio is no other witness";
  EXPECT_NE(text_of(v).find("modulus of homogeneous solids"), std::string::npos) << text_of(v);
  v = elongated_verdict(0, 0);
  v.elongated_by = ElongatedBy::inertia;
  EXPECT_GE(recommendation(v).kPa.common_error, 0.35 * 2.5) << "elongated cells have a cortex";
  EXPECT_NE(text_of(v).find("modulus of homogeneous solids"), std::string::npos) << text_of(v);
}

TEST(Recommendation, EventsBeyondTheTableCountOnTheirSide) {
  for (const double excess : {0.005, 0.2}) {  // by deformation, by the table of elongated cells
    ShapeVerdict v = elongated_verdict(0, 0, excess);
    v.elongated_by = ElongatedBy::inertia;
    JudgedModulus& judged = excess < 0.1 ? v.by_deformation : v.by_elongation;
    judged.median_kPa = median_of_events(200, 1, {.below = 150});
    Recommendation r = recommendation(v);
    EXPECT_LT(r.kPa.value, median_of_events(200, 1).value - 3 * r.kPa.error) << "the median of all, not of the rest";
    EXPECT_NE(text_of(v).find("57.1 % of 350 events have a modulus, 42.9 % softer than the table"), std::string::npos)
        << text_of(v);
    judged.median_kPa = median_of_events(63, 1, {.below = 2084});
    judged.soft_end_kPa = 0.7;
    r = recommendation(v);
    EXPECT_EQ(r.way, RecommendedWay::none);
    EXPECT_TRUE(std::isnan(r.kPa.value));
    EXPECT_EQ(code_of(r.reason), "beyond-table");
    EXPECT_EQ(r.bound(), "softer");
    EXPECT_EQ(r.bound_kPa, 0.7);
    EXPECT_NE(text_of(v).find("softer than 0.7 kPa (2.9 % of 2147 events have a modulus"), std::string::npos)
        << text_of(v);
    judged.median_kPa = median_of_events(58, 2.2, {.above = 79});
    r = recommendation(v);
    EXPECT_EQ(r.bound(), "stiffer");
    judged.median_kPa = median_of_events(40, 2.2, {.below = 30, .above = 30});
    EXPECT_EQ(recommendation(v).way, RecommendedWay::none) << "40 % of the events";
  }
}

TEST(Recommendation, FewEventsHaveNone) {
  ShapeVerdict v = elongated_verdict(0, 0);
  v.by_elongation.median_kPa = median_of_events(19, 2);
  EXPECT_EQ(code_of(recommendation(v).reason), "too-few-events");
  EXPECT_NE(text_of(v).find("19 events are too few for a median (minimum 20)"), std::string::npos) << text_of(v);
  v.by_elongation.median_kPa = median_of_events(20, 2);
  EXPECT_EQ(recommendation(v).way, RecommendedWay::elongated);
}

TEST(Recommendation, CellsThatCreepHaveNone) {
  ShapeVerdict v = elongated_verdict(0, 0);
  v.direction = 1;
  v.asymmetry_trend = {.change = 0.03, .error = 0.001, .median = 0.05};
  v.mode_4_trend = {.change = 0, .error = 0.001, .median = 0};
  EXPECT_EQ(code_of(recommendation(v).reason), "creeping");
  EXPECT_NE(text_of(v).find("`rheocyte time-course`"), std::string::npos) << text_of(v);
  v.asymmetry_trend.change = 0.008;
  EXPECT_EQ(recommendation(v).way, RecommendedWay::elongated);
}

TEST(Recommendation, OutlinesOfCellsWithACortexHaveNone) {
  // The second: cells of 1.5 kPa and 19 mN/m, far below 0.01. The limit grows with the asymmetry.
  for (const ShapeVerdict& v :
       {elongated_verdict(-0.025, 0), elongated_verdict(-0.005, 0.003), elongated_verdict(0, 0.02)}) {
    EXPECT_EQ(code_of(recommendation(v).reason), "cortex");
    EXPECT_NE(text_of(v).find("use `rheocyte moduli`"), std::string::npos) << text_of(v);
  }
  ShapeVerdict coarse = elongated_verdict(-0.0032, 0.0009);  // small solids, with another rule for the edge
  coarse.radius_px = 14;
  EXPECT_EQ(recommendation(coarse).way, RecommendedWay::elongated);
  ShapeVerdict longer = elongated_verdict(-0.005, 0.003);
  longer.asymmetry = 0.15;
  EXPECT_EQ(recommendation(longer).way, RecommendedWay::elongated);
  EXPECT_EQ(recommendation(elongated_verdict(0.007, -0.002)).way, RecommendedWay::elongated) << "as linear solids";
}

TEST(ShapeVerdict, TheErrorOfTheMedianIsThatOfItsRobustScatter) {
  const ShapeVerdict v = verdict_of(0.2);
  // Quartiles of 0.01 sin lie at +-0.00707.
  EXPECT_NEAR(v.excess.value, 0.2, 0.002);
  EXPECT_NEAR(v.excess.error, 1.25 * 0.00707 / 0.6745 / std::sqrt(200), 1e-4);
  EXPECT_EQ(v.elongated_percent(), 100);
}

TEST(ShapeVerdict, SettledCellsAreToldFromThoseThatStillChange) {
  EXPECT_NE(verdict_of(0.2).trend_text().find("settled"), std::string::npos);
  const ShapeVerdict growing = verdict_of(0.2, 0.008);
  EXPECT_NE(growing.trend_text().find("still changing"), std::string::npos) << growing.trend_text();
  // Over 90 % of the places.
  EXPECT_NEAR(growing.deformation_trend.change, 0.9 * 0.008, 5 * growing.deformation_trend.error);
}

/// Cells whose c3 grows from 0.066 to 0.074 over 60 um, while c4 and the distances from the axis change by so much.
std::string trend_of_asymmetry(double change_of_c4, double centring_per_um) {
  std::vector<ShapeExcess> excesses;
  std::vector<double> ratio, deformation, x, mode_3, mode_4, y;
  std::vector<OutlineTilt> tilt;
  std::mt19937_64 random(5);
  std::normal_distribution<double> normal;
  constexpr int events = 2000;
  for (int i = 0; i < events; ++i) {
    const double place = double(i) / events, off_axis = 0.4 * std::exp(centring_per_um * 60 * place) * normal(random);
    excesses.push_back({1, 0.2, 0.01, 0.3});
    ratio.push_back(1.5);
    deformation.push_back(0.06);
    x.push_back(60 * place);
    mode_3.push_back(0.066 + 0.008 * place + 0.01 * normal(random));
    mode_4.push_back(0.005 + change_of_c4 * place + 0.01 * normal(random));
    y.push_back(13 + off_axis);
    tilt.push_back({.sine_mode_2 = -0.05 * off_axis, .sine_mode_3 = 0, .sine_mode_4 = 0, .flank_slope = 0});
  }
  const std::vector<double> area(events, 140);
  ShapeTally tally;
  tally.take({.excess = excesses,
              .inertia_ratio = ratio,
              .area_um2 = area,
              .deformation = deformation,
              .mode_3 = mode_3,
              .x_um = x,
              .modulus_kPa = {},
              .mode_4 = mode_4,
              .y_um = y,
              .tilt = tilt});
  ShapeVerdict v = tally.verdict();
  v.direction = 1;
  v.beside_axis = tally.beside_axis(1, {.width_um = 20, .rate_ul_s = 0.04});
  return v.trend_text();
}

TEST(ShapeVerdict, AGrowingAsymmetryIsThatOfCellsThatApproachTheAxisIfC4FallsWithIt) {
  const std::string centring = trend_of_asymmetry(-0.0086, -0.006), creep = trend_of_asymmetry(0, -0.006),
                    unseen = trend_of_asymmetry(-0.0086, 0);
  EXPECT_NE(centring.find("still changing"), std::string::npos) << centring;
  EXPECT_NE(centring.find("as of cells that still approach the axis, not of cells that creep"), std::string::npos)
      << centring;
  EXPECT_NE(creep.find("as of cells that creep, not of cells that approach the axis"), std::string::npos) << creep;
  EXPECT_NE(unseen.find("but pos_y does not show it"), std::string::npos) << unseen;
}

TEST(ShapeVerdict, WithoutPlacesOrAtOnePlaceThereIsNoTrend) {
  EXPECT_NE(verdict_of(0.2, 0, 3).trend_text().find("at one place"), std::string::npos);
  EXPECT_NE(verdict_of(0.2, 0, NAN).trend_text().find("no pos_x"), std::string::npos);
  EXPECT_NE(verdict_of(0.2, 0, 60, 10).trend_text().find("too few events"), std::string::npos);
}

TEST(ShapeVerdict, RedCellsCountApart) {
  // The last one is as long as a red cell, but larger: a soft cell.
  const std::vector<ShapeExcess> excesses{
      {1, 1.9, 0.01, 0.1}, {1, 0.001, 0.01, 0.1}, {1, NAN, 0.01, 0.1}, {1, 1.2, 0.01, 0.1}};
  const std::vector<double> ratio{2.9, 1.001, NAN, 2.2}, deformation{0.2, 0.01, 0.01, 0.16}, area{40, 60, 60, 120};
  ShapeTally tally;
  tally.take({excesses, ratio, area, deformation, {}, {}, {}, {}, {}});
  const ShapeVerdict v = tally.verdict();
  EXPECT_EQ(v.red_cells, 1u);
  EXPECT_EQ(v.judged, 2u);
  ASSERT_FALSE(shape_lines(v).empty());
  EXPECT_NE(shape_lines(v).back().find("1 event is as small and long as red cells"), std::string::npos);
}

TEST(ShapeVerdict, AFewEventsDecideNothing) {
  EXPECT_EQ(verdict_of(0.2, 0, 60, 4).fit(), ShapeVerdict::Fit::unknown);
  EXPECT_NE(verdict_of(0.2, 0, 60, 1).text().find("1 event is too few"), std::string::npos);
  // Above 0.05, but no more than two standard errors from what the model has.
  ShapeVerdict v = verdict_of(0.2);
  v.excess = {0.15, 0.1};
  EXPECT_EQ(v.fit(), ShapeVerdict::Fit::doubtful);
}

TEST(ShapeVerdict, OfNothingNothingIsSaid) {
  EXPECT_EQ(ShapeTally().verdict().fit(), ShapeVerdict::Fit::unknown);
  EXPECT_TRUE(shape_lines(ShapeTally().verdict()).empty());
}

}  // namespace
}  // namespace rheocyte::shape_verdict_test

// What is said about the shapes of a recording.
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "extract/common_errors.h"
#include "extract/shape_tally.h"

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
  EXPECT_NE(v.recommended(), ShapeVerdict::Modulus::by_deformation);
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

/// Thirty cells with moduli as of elongated ones, whose c_4 and c_5 are beyond those of solids by so much.
ShapeVerdict elongated_verdict(double mode_4, double mode_5, double excess = 0.2) {
  const std::vector<ShapeExcess> excesses(30, {1, excess, 0.01, 0.3});
  const std::vector<double> ratio(30, 1 + excess), deformation(30, 0.02), modulus(30, 1), elongated(30, 2.5),
      error(30, 0.1), elongation(30, 1.2), tension(30, 250), fourth(30, mode_4), fifth(30, mode_5);
  ShapeTally tally;
  tally.take({.excess = excesses,
              .inertia_ratio = ratio,
              .area_um2 = {},
              .deformation = deformation,
              .mode_3 = {},
              .x_um = {},
              .modulus_kPa = modulus,
              .elongation = {elongated, error, elongation, error, tension, error},
              .mode_4_excess = fourth,
              .mode_5_excess = fifth});
  ShapeVerdict verdict = tally.verdict();
  verdict.by_deformation_kPa = {1, 0.01, 0.03};
  verdict.elongated_common_error = 0.02;
  return verdict;
}

TEST(ShapeVerdict, CellsOfAnotherTableHaveAModulusAndNoTension) {
  ShapeVerdict v = elongated_verdict(0.002, -0.003);
  v.other = {"LE-2D-26", "linear solids in the tube", {0.002, 0.001}, 1.04, 1.048};
  ASSERT_EQ(v.fit(), ShapeVerdict::Fit::other_table);
  EXPECT_EQ(v.recommended(), ShapeVerdict::Modulus::elongated);
  EXPECT_GT(v.recommended_kPa().common_error, 0.027 * 2.5);
  const std::string text = v.recommended_text();
  EXPECT_NE(text.find("but linear solids in the tube"), std::string::npos) << text;
  EXPECT_EQ(text.find("tension"), std::string::npos) << text;
}

TEST(ShapeVerdict, ElongationAndTensionAreToldWithBothErrorsAsTheModulusIs) {
  ShapeVerdict v = elongated_verdict(0.002, -0.003);
  v.elongation.common_error = 0.005;
  v.axial_tension_Pa.common_error = 10;
  const std::string told = shape_lines(v).at(2);
  EXPECT_NE(told.find("elongation 1.2 +- 0 +- 0.005, axial tension 250 +- 0 +- 10 Pa"), std::string::npos) << told;
  EXPECT_NE(v.recommended_text().find("a tension of 250 +- 0 +- 10 Pa along the flow"), std::string::npos);
}

TEST(ShapeVerdict, TheModulusOfElongatedCellsIsToldAndRecommended) {
  const ShapeVerdict v = elongated_verdict(0.002, -0.003);
  EXPECT_NEAR(v.modulus_ratio, 0.4, 1e-6);  // kept in single precision
  EXPECT_EQ(v.with_elongation, 30u);
  EXPECT_NEAR(v.axial_tension_Pa.value, 250, 1e-3);
  EXPECT_EQ(v.recommended(), ShapeVerdict::Modulus::elongated);
  const auto lines = shape_lines(v);
  ASSERT_FALSE(lines.empty());
  EXPECT_NE(lines.back().find("report E = 2.5 +- 0 +- 0.08 kPa (median"), std::string::npos) << lines.back();
  EXPECT_NE(lines.back().find("a tension of 250 +- 0 Pa"), std::string::npos) << lines.back();
}

TEST(ShapeVerdict, MoreEventsMakeTheErrorByScatterSmallerAndNotWhatTheyHaveInCommon) {
  const auto recommended = [](int events) {
    std::vector<double> moduli;
    for (int i = 0; i < events; ++i) moduli.push_back(2 + 0.5 * std::sin(2.4 * i));
    ShapeVerdict v = elongated_verdict(0, 0);
    v.elongated_kPa = distribution_of(moduli);
    return v.recommended_kPa();
  };
  const Median few = recommended(100), many = recommended(10000);
  // Quartiles of sin lie at +-0.7071.
  EXPECT_NEAR(many.error, 1.25 * 0.5 * 0.7071 / 0.6745 / 100, 1e-4);
  EXPECT_NEAR(few.error / many.error, 10, 0.5);
  EXPECT_NEAR(many.common_error, std::hypot(0.02, common_error_of_other_shapes) * 2, 1e-3);
  EXPECT_NEAR(few.common_error, many.common_error, 1e-2);
}

TEST(ShapeVerdict, WhatMakesCellsLongIsAnErrorOfCellsOfOtherShapesAlone) {
  const ShapeVerdict of_model = elongated_verdict(0, 0, 0.005), longer = elongated_verdict(0, 0);
  ASSERT_EQ(of_model.fit(), ShapeVerdict::Fit::model);
  ASSERT_EQ(longer.fit(), ShapeVerdict::Fit::elongated);
  ASSERT_EQ(of_model.recommended(), ShapeVerdict::Modulus::elongated);
  EXPECT_DOUBLE_EQ(of_model.recommended_kPa().common_error, 0.02 * of_model.elongated_kPa.median);
  EXPECT_DOUBLE_EQ(longer.recommended_kPa().common_error,
                   std::hypot(0.02, common_error_of_other_shapes) * longer.elongated_kPa.median);
}

TEST(ShapeVerdict, CellsOfTheModelAreReportedByTheirDeformation) {
  ShapeVerdict v = elongated_verdict(0, 0, 0.005);
  v.elongated_kPa.median = 1.04;
  EXPECT_EQ(v.recommended(), ShapeVerdict::Modulus::by_deformation);
  EXPECT_NE(v.recommended_text().find("report E = 1 +- 0.01 +- 0.03 kPa"), std::string::npos) << v.recommended_text();
  ShapeVerdict without = v;  // as by a published table, whose errors nobody knows
  without.by_deformation_kPa.common_error = std::nan("");
  EXPECT_NE(
      without.recommended_text().find("report E = 1 +- 0.01 kPa (median, from area and deformation; the error is"),
      std::string::npos)
      << without.recommended_text();
}

TEST(ShapeVerdict, WhereOutlinesAndDeformationDisagreeTheOutlinesAreBelieved) {
  ShapeVerdict v = elongated_verdict(0, 0, 0.005);
  v.elongated_kPa.median = 1.2;
  EXPECT_EQ(v.recommended(), ShapeVerdict::Modulus::elongated);
  EXPECT_NE(v.recommended_text().find("that from area and deformation, 1 +- 0.01 +- 0.03, is 17 % lower"),
            std::string::npos)
      << v.recommended_text();
  v.by_deformation_kPa.common_error = 0.1;
  EXPECT_EQ(v.recommended(), ShapeVerdict::Modulus::by_deformation) << "within three errors";
  v = elongated_verdict(0, 0, 0.005);
  v.with_elongation = 25;
  EXPECT_EQ(v.recommended(), ShapeVerdict::Modulus::by_deformation) << "of 30 events";
  v = elongated_verdict(0, 0, 0.005);
  v.elongated_by = ElongatedBy::inertia;
  EXPECT_EQ(v.recommended(), ShapeVerdict::Modulus::by_deformation) << "which is told by the deformation, too";
}

TEST(ShapeVerdict, AMedianOfCellsWithoutTheirStiffOrSoftOnesIsNotRecommended) {
  ShapeVerdict v = elongated_verdict(0, 0, 0.005);
  v.elongated_kPa.median = 1;
  v.with_deformation = 20;
  v.too_stiff = 10;
  EXPECT_EQ(v.recommended(), ShapeVerdict::Modulus::elongated);
  EXPECT_NE(v.recommended_text().find("10 of 30 events are too stiff for a modulus from area and deformation, whose "
                                      "median would be that of the softer ones."),
            std::string::npos)
      << v.recommended_text();
  v.with_elongation = 20;
  EXPECT_EQ(v.recommended(), ShapeVerdict::Modulus::none);
  EXPECT_NE(v.recommended_text().find("`rheocyte population` takes all"), std::string::npos) << v.recommended_text();
  v.too_soft = 10;
  EXPECT_EQ(v.recommended(), ShapeVerdict::Modulus::by_deformation) << "as many at both ends: the median stays";
  v.too_stiff = 0;
  EXPECT_NE(v.recommended_text().find("10 of 30 events are too soft for"), std::string::npos) << v.recommended_text();
}

TEST(ShapeVerdict, CellsThatCreepHaveNoModulusHere) {
  ShapeVerdict v = elongated_verdict(0, 0);
  v.direction = 1;
  v.asymmetry_trend = {.change = 0.03, .error = 0.001, .median = 0.05};
  v.mode_4_trend = {.change = 0, .error = 0.001, .median = 0};
  EXPECT_EQ(v.recommended(), ShapeVerdict::Modulus::none);
  EXPECT_NE(v.recommended_text().find("`rheocyte time-course`"), std::string::npos) << v.recommended_text();
  v.asymmetry_trend.change = 0.008;
  EXPECT_EQ(v.recommended(), ShapeVerdict::Modulus::elongated);
}

TEST(ShapeVerdict, OutlinesOfCellsWithACortexHaveNoModulusOfASolid) {
  for (const ShapeVerdict& v : {elongated_verdict(-0.025, 0), elongated_verdict(0, 0.02)}) {
    EXPECT_EQ(v.recommended(), ShapeVerdict::Modulus::none);
    EXPECT_NE(v.recommended_text().find("use `rheocyte moduli`"), std::string::npos) << v.recommended_text();
  }
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
  const std::vector<ShapeExcess> excesses{{1, 1.9, 0.01, 0.1}, {1, 0.001, 0.01, 0.1}, {1, NAN, 0.01, 0.1}};
  const std::vector<double> ratio{2.9, 1.001, NAN}, deformation{0.2, 0.01, 0.01};
  ShapeTally tally;
  tally.take({excesses, ratio, {}, deformation, {}, {}, {}, {}, {}});
  const ShapeVerdict v = tally.verdict();
  EXPECT_EQ(v.red_cells, 1u);
  EXPECT_EQ(v.judged, 1u);
  EXPECT_EQ(v.elongated, 0u);
  ASSERT_FALSE(shape_lines(v).empty());
  EXPECT_NE(shape_lines(v).back().find("1 event has an inertia ratio above 2"), std::string::npos);
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

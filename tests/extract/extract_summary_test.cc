// The summary of a recording says what its numbers are, and survives the way from one process to the other.
#include "extract/extract_summary.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "store/bytes.h"

namespace rheocyte::extract_summary_test {
namespace {

TEST(ExtractSummary, QuartilesAreInterpolatedBetweenValues) {
  std::vector<double> values{4, 1, 3, 2};
  const auto d = distribution_of(values);
  EXPECT_EQ(d.first_quartile, 1.75);
  EXPECT_EQ(d.median, 2.5);
  EXPECT_EQ(d.third_quartile, 3.25);
  EXPECT_EQ(d.mean, 2.5);
  EXPECT_NEAR(d.standard_deviation, std::sqrt(5.0 / 3), 1e-15);
}

TEST(ExtractSummary, NoEventsHaveNoDistributionAndOneHasNoSpread) {
  EXPECT_TRUE(std::isnan(distribution_of({}).median));
  std::vector<double> one{2};
  EXPECT_EQ(distribution_of(one).median, 2);
  EXPECT_TRUE(std::isnan(distribution_of(one).standard_deviation));
}

TEST(ExtractSummary, WhatCountsAsValidIsToldApartFromOtherModuli) {
  ExtractSummary s;
  s.recorded = 30;
  s.counts[0] = 25;
  s.counts[std::size_t(ModulusState::regularised)] = 3;
  s.counts[std::size_t(ModulusState::too_small)] = 2;
  s.median_standard_error_kPa = NAN;
  const std::string line = in_one_line(s);
  EXPECT_TRUE(line.starts_with("28 of 30 events (25 valid, 3 regularised), E median")) << line;
  EXPECT_TRUE(line.ends_with("; 2 too small")) << line;
  s.counts[std::size_t(ModulusState::regularised)] = 0;
  EXPECT_TRUE(in_one_line(s).starts_with("25 of 30 events, E median")) << in_one_line(s);
}

TEST(ExtractSummary, ComesBackFromItsBytes) {
  ExtractSummary s;
  s.recorded = 7;
  s.counts = {1, 2, 0, 3, 0, 1};
  s.labels.chip = "c7";
  s.modulus_kPa = {1, 0.5, 2, 1.25, std::numeric_limits<double>::quiet_NaN()};
  s.mean_viscosity_mPas = 5.5;
  s.table = "name \"quoted\"";
  s.conditions = {{20, 0.04}, 0.34};
  s.warnings = {"first.", "second."};
  const auto back = from_bytes<ExtractSummary>(to_bytes(s)).value();
  EXPECT_EQ(back.recorded, 7U);
  EXPECT_EQ(back.counts, s.counts);
  EXPECT_EQ(back.modulus_kPa.third_quartile, 2);
  EXPECT_TRUE(std::isnan(back.modulus_kPa.standard_deviation));
  EXPECT_EQ(back.table, s.table);
  EXPECT_EQ(back.conditions.pixel_size_um, 0.34);
  EXPECT_EQ(back.warnings, s.warnings);
  EXPECT_EQ(back.labels.chip, "c7");
}

}  // namespace
}  // namespace rheocyte::extract_summary_test

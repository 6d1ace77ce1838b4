// The rules by which a recording is taken: temperature, quantities, gates, and what contradicts itself.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "case/user_error.h"
#include "events/extract_settings.h"
#include "events/gates.h"
#include "events/plausibility.h"
#include "events/recording_temperature.h"
#include "measurement/recording_writer.h"
#include "measurement/shape_source.h"

namespace rheocyte::recording_rules_test {
namespace {

/// A recording with the usual metadata and three events, and what a test adds to it.
class RecordingRules : public ::testing::Test {
 protected:
  const Recording& recording(const std::function<void(test::RecordingWriter&)>& add = [](test::RecordingWriter&) {}) {
    const auto file = folder_ / (std::to_string(++made_) + ".rtdc");
    {
      test::RecordingWriter writer(file);
      test::write_usual_metadata(writer);
      writer.scalar("area_um", {80, 90, 100});
      writer.scalar("deform", {0.02, NAN, 0.04});
      add(writer);
    }
    return recording_.emplace(file);
  }
  static std::string refusal(const std::function<void()>& work) {
    try {
      work();
    } catch (const UserError& error) {
      return error.what();
    }
    return "";
  }

 private:
  test::ScratchFolder folder_;
  int made_ = 0;
  std::optional<Recording> recording_;
};

TEST_F(RecordingRules, TheTemperatureIsThatOfTheEventsThenOfTheMetadataUnlessOneIsGiven) {
  const auto with_temperatures = [](test::RecordingWriter& writer) { writer.scalar("temp", {25, 0, 25.5}); };
  MeasuringOptions options;
  const RecordingTemperature of_events = temperature_of(options, recording(with_temperatures));
  EXPECT_EQ(of_events.from, TemperatureSource::feature);
  EXPECT_GE(of_events.celsius, 25) << "the median of the possible ones";
  EXPECT_TRUE(std::isnan(of_events.of_others)) << "0 degC is no temperature of a buffer";
  options.temperature_if_missing = "30";
  EXPECT_EQ(temperature_of(options, recording(with_temperatures)).of_others, 23) << "the metadata's, before the option";
  options.temperature = "metadata";
  const RecordingTemperature of_metadata = temperature_of(options, recording(with_temperatures));
  EXPECT_EQ(of_metadata.from, TemperatureSource::metadata);
  EXPECT_EQ(of_metadata.celsius, 23);
  options.temperature = "20";
  const RecordingTemperature given = temperature_of(options, recording(with_temperatures));
  EXPECT_EQ(given.from, TemperatureSource::given);
  EXPECT_EQ(given.celsius, 20);
  ASSERT_EQ(given.warnings.size(), 1U) << "a recorded one is replaced";
  options.temperature = "feature";
  EXPECT_NE(refusal([&] { temperature_of(options, recording()); }).find("no temperature of each event"),
            std::string::npos);
}

TEST_F(RecordingRules, QuantitiesAreThoseOfTheMetadataUnlessTheyAreGiven) {
  MeasuringOptions options;
  const ExtractSettings stored = extract_settings(options, PixelUse::correct, recording());
  EXPECT_EQ(stored.conditions.flow.width_um, 20);
  EXPECT_EQ(stored.conditions.flow.rate_ul_s, 0.04);
  EXPECT_EQ(stored.conditions.pixel_size_um, 0.34);
  EXPECT_EQ(stored.model_text(), "buyukurganci-2022");
  EXPECT_LT(stored.conditions.flow.exponent, 1) << "CellCarrier is shear-thinning";
  options.channel_width_um = 30;
  options.viscosity_mPas = 5;
  const ExtractSettings given = extract_settings(options, PixelUse::ignore, recording());
  EXPECT_EQ(given.conditions.flow.width_um, 30);
  EXPECT_EQ(given.conditions.flow.viscosity_mPas, 5);
  EXPECT_EQ(given.conditions.pixel_size_um, 0) << "nothing is corrected";
  EXPECT_EQ(given.model_text(), "given");
}

TEST_F(RecordingRules, GatesHoldTheirEndsAndNoEventWithoutANumber) {
  const Recording& events = recording();
  ShapeSource shapes(events, 0.34);
  EventFeatures features(events, shapes);
  const auto inside = [&](const GateOptions& options) {
    const Gates gates(options);
    gates.check(features);
    std::vector<char> found(3);
    gates.apply(features, 0, found);
    return std::vector<int>(found.begin(), found.end());
  };
  EXPECT_EQ(inside({{"area_um=90"}, {}}), (std::vector{0, 1, 1}));
  EXPECT_EQ(inside({{}, {"area_um=90"}}), (std::vector{1, 1, 0}));
  EXPECT_EQ(inside({{}, {"deform=0.04"}}), (std::vector{1, 0, 1}));
  EXPECT_EQ(inside({{}, {}, {}, {{2, 0}}}), (std::vector{1, 0, 1})) << "chosen events";
  EXPECT_EQ(inside({{"area_um=90"}, {}, {"area_um,deform=50,0:120,0:120,1:50,1"}}), (std::vector{0, 0, 1}));
  EXPECT_EQ(Gates({{"area_um=40"}, {"area_um=90.5"}}).description(), "40 <= area_um <= 90.5");
  const Gates both({{"area_um=40", "deform=0.01"}, {"area_um=90.5"}});
  EXPECT_EQ(both.description_without({"area_um"}), "0.01 <= deform");
  EXPECT_EQ(both.limits_of("area_um").min, 40);
  EXPECT_EQ(both.limits_of("area_um").max, 90.5);
  EXPECT_TRUE(std::isinf(both.limits_of("deform").max) && std::isinf(both.limits_of("bright_avg").min));
  EXPECT_NE(refusal([&] {
              inside({{"aera_um=90"}, {}});
            }).find("has no feature aera_um, for which --min gives"),
            std::string::npos);
  EXPECT_NE(refusal([] { Gates({{"area_um=90"}, {"area_um=40"}}); }).find("contradict each other"), std::string::npos);
  EXPECT_NE(refusal([] { Gates({{"area_um"}, {}}); }).find("give a feature and a number"), std::string::npos);
}

TEST_F(RecordingRules, WhatContradictsItselfInARecordingIsSaid) {
  EXPECT_TRUE(contradictions(recording(), 0.04, 0.34).empty());
  const Recording& odd = recording([](test::RecordingWriter& writer) {
    writer.number("setup:flow rate sample", 0.02);
    writer.number("setup:flow rate sheath", 0.06);
    writer.scalar("area_cvx", {80 / 0.26 / 0.26, 90 / 0.26 / 0.26, 100 / 0.26 / 0.26});
  });
  const auto sentences = contradictions(odd, 0.04, 0.34);
  ASSERT_EQ(sentences.size(), 2U);
  EXPECT_NE(sentences[0].find("sample and sheath together are 0.08 ul/s"), std::string::npos);
  EXPECT_NE(sentences[1].find("pixels of 0.26 um"), std::string::npos);
  EXPECT_TRUE(contradictions(odd, 0, 0).empty()) << "what is given is not compared";
}

TEST(MeasuringOptions, ThatContradictEachOtherAreRefused) {
  const auto check = [](const std::function<void(MeasuringOptions&)>& change) {
    MeasuringOptions options;
    options.viscosity_mPas = 5;
    change(options);
    check_options(options);
  };
  EXPECT_NO_THROW(check([](MeasuringOptions&) {}));
  EXPECT_THROW(check([](MeasuringOptions& o) { o.medium = "water"; }), UserError);
  EXPECT_THROW(check([](MeasuringOptions& o) { o.temperature = "23"; }), UserError);
  EXPECT_THROW(check([](MeasuringOptions& o) { o.viscosity_mPas = 0.1; }), UserError);
  for (const char* impossible : {"296", "feature"})
    EXPECT_THROW(check([=](MeasuringOptions& o) {
                   o.viscosity_mPas.reset();
                   o.temperature_if_missing = impossible;
                 }),
                 UserError);
  EXPECT_THROW(check_table("LE-2D-26", Section::tube), UserError);
  EXPECT_NO_THROW(check_table("", Section::tube));
}

}  // namespace
}  // namespace rheocyte::recording_rules_test

// What cannot be so is refused, or replaced by what can, and said; beyond what a table covers no modulus goes without a
// flag.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "lookup_table_file.h"
#include "measurement/recording.h"
#include "measurement/recording_writer.h"
#include "robustness/run_program.h"

namespace rheocyte::implausible_recording_test {
namespace {

namespace fs = std::filesystem;
using test::RecordingWriter;

class Implausible : public testing::Test {
 protected:
  Implausible() { test::write_lookup_table(folder_ / "table.txt"); }

  void write_recording(const std::function<void(RecordingWriter&)>& more) const {
    RecordingWriter writer(folder_ / "a.rtdc");
    test::write_usual_metadata(writer);
    writer.scalar("area_um", {80, 80, 80});
    writer.scalar("deform", {0.03, 0.03, 0.03});
    more(writer);
  }
  static void replace(RecordingWriter& writer, const std::string& key, double value) {
    ::H5Adelete(writer.root(), key.c_str());
    writer.number(key, value);
  }
  test::Ended extract(std::vector<std::string> more = {}) const {
    more.insert(more.begin(), {RHEOCYTE, "extract", path("a.rtdc"), "--table", path("table.txt")});
    return test::run({more});
  }
  std::vector<double> column(const std::string& feature) const {
    const Recording recording(folder_ / "a_rheocyte.rtdc");
    std::vector<double> values(recording.events());
    recording.read_scalar(feature, 0, values);
    return values;
  }
  /// Moduli of the three events, with a word on standard error.
  std::vector<double> moduli(const std::string& words, const std::vector<std::string>& more = {}) const {
    const auto ended = extract(more);
    EXPECT_EQ(ended.exit_code, 0) << ended.err;
    EXPECT_NE(ended.err.find(words), std::string::npos) << "wanted: " << words << "\n   got: " << ended.err;
    return column("emodulus");
  }
  void expect_refusal(const std::string& words, const std::vector<std::string>& more = {}) const {
    const auto ended = extract(more);
    EXPECT_EQ(ended.exit_code, 2) << words;
    EXPECT_NE(ended.err.find(words), std::string::npos) << "wanted: " << words << "\n   got: " << ended.err;
  }
  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  test::ScratchFolder folder_;
};

TEST_F(Implausible, TemperaturesWithoutASensorGiveWayToTheMetadata) {
  const auto temperatures = [&](double celsius) {
    write_recording([&](RecordingWriter& writer) { writer.scalar("temp", {celsius, celsius, celsius}); });
  };
  temperatures(23);
  const auto expected = moduli("");
  for (const double without : {-1.0, 0.0, 296.15}) {
    temperatures(without);
    EXPECT_EQ(moduli("the temperatures of the events are impossible (for example " + std::to_string(int(without))),
              expected);
  }
  temperatures(NAN);
  EXPECT_EQ(moduli("the temperatures of the events are no numbers. setup:temperature, 23 degC, is used."), expected);
  expect_refusal("the temperatures of the events are no numbers", {"--temperature", "feature"});
}

TEST_F(Implausible, WithoutAnyPossibleTemperatureTheRecordingIsRefused) {
  write_recording([](RecordingWriter& writer) {
    replace(writer, "setup:temperature", 0);
    writer.scalar("temp", {0, 0, 0});
  });
  expect_refusal(
      "setup:temperature is 0, but a buffer in a channel has 2 to 60 degC. Give it in degrees Celsius "
      "(--temperature-if-missing)");
  write_recording([](RecordingWriter& writer) { replace(writer, "setup:temperature", 296.15); });
  expect_refusal("(296.15 K are 23 degC)");
  expect_refusal("--temperature 296.15: a buffer in a channel has 2 to 60 degC (296.15 K are 23 degC).",
                 {"--temperature", "296.15"});
  expect_refusal("--temperature -1: a buffer in a channel has", {"--temperature=-1"});
}

TEST_F(Implausible, TextsThatAreNoNumbersAreShownAsTheyAre) {
  const auto stored = [&](const char* key, const char* text) {
    write_recording([&](RecordingWriter& writer) {
      ::H5Adelete(writer.root(), key);
      writer.text(key, text);
    });
  };
  stored("imaging:pixel size", "0,34");
  expect_refusal("imaging:pixel size is \"0,34\", which is not a positive number; give it with --pixel-size-um");
  stored("setup:temperature", "23,5");
  expect_refusal(
      "setup:temperature is \"23,5\", which is not a number. Give it in degrees Celsius (--temperature-if-missing)");
  moduli("setup:temperature is \"23,5\", which is not a number.", {"--temperature-if-missing", "23"});
  for (const char* option : {"--temperature", "--temperature-if-missing"})
    expect_refusal(std::string(option) + " 23,5: give degrees Celsius", {option, "23,5"});
}

TEST_F(Implausible, SingleEventsWithoutATemperatureHaveNoModulus) {
  write_recording([](RecordingWriter& writer) { writer.scalar("temp", {23, -1, NAN}); });
  const auto values = moduli("2 events have no modulus, because their temperatures are impossible");
  EXPECT_TRUE(std::isfinite(values[0]) && std::isnan(values[1]) && std::isnan(values[2]));
  EXPECT_EQ(column("userdef0"), (std::vector<double>{0, 1, 1}));
}

TEST_F(Implausible, ATemperatureOfTheUserMayReplaceRecordedOnesOrOnlyFillGaps) {
  write_recording([](RecordingWriter& writer) { writer.scalar("temp", {25, 25, 25}); });
  const auto recorded = moduli(""),
             replaced = moduli("replaces the recorded temperature (25 degC, median of the", {"--temperature", "30"});
  EXPECT_LT(replaced[0], recorded[0]);
  EXPECT_EQ(moduli("", {"--temperature-if-missing", "30"}), recorded);
  write_recording([](RecordingWriter& writer) { ::H5Adelete(writer.root(), "setup:temperature"); });
  EXPECT_NEAR(moduli("", {"--temperature-if-missing", "30"})[0], replaced[0], 1e-12);
}

TEST_F(Implausible, ATemperatureForWhereItIsMissingFillsSingleEventsToo) {
  write_recording([](RecordingWriter& writer) { writer.scalar("temp", {25, 30, 30}); });
  const auto expected = moduli("");
  write_recording([](RecordingWriter& writer) {
    ::H5Adelete(writer.root(), "setup:temperature");
    writer.scalar("temp", {25, 0, NAN});
  });
  EXPECT_EQ(moduli("2 events have temperatures that are impossible (for example 0 degC); for them 30 degC is used.",
                   {"--temperature-if-missing", "30"}),
            expected);
  write_recording([](RecordingWriter& writer) {
    replace(writer, "setup:temperature", 30);
    writer.scalar("temp", {25, 0, NAN});
  });
  EXPECT_EQ(moduli("for them 30 degC is used, setup:temperature.", {"--temperature-if-missing", "20"}), expected)
      << "what is recorded comes first";
}

TEST_F(Implausible, BeyondTheInertiaOfTheTableModuliAreFlagged) {
  write_recording([](RecordingWriter& writer) { replace(writer, "setup:flow rate", 2.2); });
  const auto values = moduli("have Reynolds numbers above 3, up to 53", {"--viscosity-mPas", "1.2"});
  EXPECT_TRUE(std::isfinite(values[0]));
  EXPECT_EQ(column("userdef0"), (std::vector<double>{10, 10, 10}));
  EXPECT_NE(test::content_of(folder_ / "a_rheocyte.tsv").find("inertial"), std::string::npos);
  write_recording([](RecordingWriter&) {});
  moduli("");
  EXPECT_EQ(column("userdef0"), (std::vector<double>{0, 0, 0}));
}

TEST_F(Implausible, ContradictionsAreNamed) {
  write_recording([](RecordingWriter& writer) {
    writer.number("setup:flow rate sample", 0.01);
    writer.number("setup:flow rate sheath", 0.15);
    writer.scalar("area_cvx", {692, 692, 692});
  });
  moduli("setup:flow rate is 0.04 ul/s, but sample and sheath together are 0.16 ul/s");
  const auto agreeing = extract({"--flow-rate-ul-s", "0.16"});
  EXPECT_EQ(agreeing.err.find("sheath"), std::string::npos) << "the user knows: " << agreeing.err;
  EXPECT_EQ(agreeing.err.find("area_cvx"), std::string::npos) << "80 um^2 are 692 pixels of 0.34 um";
  moduli("the pixel size is 0.68 um, but areas in um^2 and in pixels (area_um, area_cvx) belong to pixels of 0.34 um.",
         {"--pixel-size-um", "0.68"});
}

TEST_F(Implausible, DeformationsInPerCentAreRefused) {
  const auto stored = [&](const char* feature, const std::vector<double>& values) {
    RecordingWriter writer(folder_ / "a.rtdc");
    test::write_usual_metadata(writer);
    writer.scalar("area_um", {80, 80, 80});
    writer.scalar(feature, values);
  };
  stored("deform", {2.5, 3, NAN});
  expect_refusal("deform is 2.75 at the median, and cannot exceed 1: is it in per cent? Store it as a fraction.");
  stored("circ", {97.5, 97, 96});
  expect_refusal("circ is 97 at the median, and cannot exceed 1: is it in per cent?");
  stored("deform", {0.03, 0.03, 1.5});
  EXPECT_EQ(extract().exit_code, 0) << "one damaged event is no unit";
}

TEST_F(Implausible, NumbersInOtherUnitsAreRefused) {
  write_recording([](RecordingWriter&) {});
  expect_refusal("0.005 mPa s is less than the viscosity of any liquid that cells live in",
                 {"--viscosity-mPas", "0.005"});
  write_recording([](RecordingWriter& writer) { replace(writer, "imaging:pixel size", 340); });
  expect_refusal("imaging:pixel size is 340, outside 0.01 .. 10 um");
  write_recording([](RecordingWriter& writer) { replace(writer, "setup:channel width", 2e-5); });
  expect_refusal("setup:channel width is 2e-05, outside 1 .. 10000 um");
}

}  // namespace
}  // namespace rheocyte::implausible_recording_test

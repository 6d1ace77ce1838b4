// A case that is written and read again is the same case to the last bit.
#include "case/write_case.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "case/read_case.h"

namespace rheocyte::write_case_test {
namespace {

std::vector<Case> cases_of_all_laws() {
  const std::string common = "cell.radius_um = 7.66\ncell.bulk.young_modulus_kPa = 3.4370000000000003\n";
  const std::string newtonian = "flow.rate_ul_per_s = 0.04\nflow.viscosity_mPas = 1e7\n";
  const std::string power_law =
      "flow.rate_ul_per_s = 1e-9\nflow.law = \"power-law\"\nflow.consistency_Pa_sn = 0.4057\nflow.exponent = 0.6039\n";
  const std::string in_time = "cell.viscosity_mPas = 15\ntime.end_us = 500\n";
  return {
      parse_case("channel.width_um = 20\n" + common + newtonian, "newtonian"),
      parse_case("channel.radius_um = 10.94\n" + common + power_law, "power law"),
      parse_case("channel.width_um = 20\ncell.bulk.law = \"mooney-rivlin\"\n" + common + newtonian, "mooney"),
      parse_case("channel.width_um = 20\ncell.bulk.law = \"linear\"\n" + common + newtonian, "linear"),
      parse_case("channel.width_um = 20\n" + common + newtonian + in_time, "in time"),
      parse_case("channel.width_um = 20\ntime.scheme = \"partitioned\"\n" + common + newtonian + in_time, "splitting"),
      parse_case("channel.width_um = 20\nchannel.length_um = 200\nflow.pressure_drop_Pa = 1e3\n"
                 "flow.viscosity_mPas = 15\n" +
                     common,
                 "pressure drop"),
      parse_case(
          "channel.profile.x_um = [60, 100.1]\nchannel.profile.R_um = [21.88, 10.94]\n" + common + newtonian + in_time,
          "profile"),
      parse_case("channel.section = \"square\"\nchannel.width_um = 20\n" + common + power_law, "square"),
      parse_case("channel.section = \"square\"\nchannel.width_um = 20\ncell.offset_um = [0, 1]\n" + common + newtonian,
                 "off the axis"),
      parse_case("channel.section = \"rectangle\"\nchannel.width_um = 20\nchannel.height_um = 30\n"
                 "channel.camera_degree = 20\ncell.cortex.law = \"linear\"\ncell.cortex.modulus_mN_per_m = 1\n" +
                     common + newtonian,
                 "rectangle"),
      parse_case("channel.width_um = 20\ncell.bulk.law = \"fung\"\ncell.bulk.stiffening = 0.7\n" + common + newtonian,
                 "fung"),
      parse_case("channel.width_um = 20\ncell.cortex.law = \"skalak\"\ncell.cortex.modulus_mN_per_m = 1\n"
                 "cell.cortex.area_constant = 30.1\n" +
                     common + newtonian,
                 "skalak")};
}

TEST(WriteCase, WhatIsWrittenIsReadBackToTheSameBits) {
  for (const Case& c : cases_of_all_laws()) {
    const Case again = parse_case(to_toml(c), "copy");
    EXPECT_EQ(to_json(again), to_json(c));
    EXPECT_EQ(to_toml(again), to_toml(c));
    EXPECT_EQ(case_hash(again), case_hash(c));
  }
}

TEST(WriteCase, ANegativeZeroIsZero) {
  // Written without a point, -0.0 would come back as the integer 0.
  const std::string text =
      "channel.profile.x_um = [-0.0, 100]\nchannel.profile.R_um = [21.88, 10.94]\n"
      "cell.radius_um = 7.66\ncell.bulk.young_modulus_kPa = 3\nflow.rate_ul_per_s = 0.04\n"
      "flow.viscosity_mPas = 15\ncell.viscosity_mPas = 15\ntime.end_us = 500\n";
  const std::string written = to_toml(parse_case(text, "case"));
  EXPECT_EQ(to_toml(parse_case(written, "copy")), written);
  const std::vector<std::string> setting{"channel.profile.x_um=[-0.0, 100]"};
  EXPECT_EQ(to_toml(parse_case(text, "case", setting)), written);
}

TEST(WriteCase, OnlyKeysWithAnEffectAreWritten) {
  const auto json = to_json(cases_of_all_laws()[0]);
  EXPECT_FALSE(json["flow"].contains("exponent"));
  EXPECT_FALSE(json["channel"].contains("radius_um"));
  EXPECT_FALSE(json["cell"]["bulk"].contains("c1_fraction"));
  EXPECT_EQ(json["flow"]["law"], "newtonian");
  EXPECT_EQ(json["flow"]["density_kg_per_m3"], 1000.0);
}

TEST(WriteCase, TheConstantsOfFungAndSkalakAreWrittenWithTheirLaws) {
  const auto cases = cases_of_all_laws();
  const auto fung = to_json(cases[cases.size() - 2]), skalak = to_json(cases.back());
  EXPECT_EQ(fung["cell"]["bulk"]["stiffening"], 0.7);
  EXPECT_FALSE(fung["cell"]["cortex"].contains("area_constant"));
  EXPECT_EQ(skalak["cell"]["cortex"]["area_constant"], 30.1);
  EXPECT_FALSE(skalak["cell"]["bulk"].contains("stiffening"));
  const std::vector<std::string> other{"cell.bulk.stiffening=0.71"};
  EXPECT_NE(case_hash(parse_case(to_toml(cases[cases.size() - 2]), "other", other)),
            case_hash(cases[cases.size() - 2]));
}

TEST(WriteCase, TheHashSeesEveryValueAndNothingElse) {
  const auto cases = cases_of_all_laws();
  EXPECT_EQ(case_hash(cases[0]).size(), 16u);
  EXPECT_NE(case_hash(cases[0]), case_hash(cases[3]));
  const auto reordered = parse_case("# a comment\n" + to_toml(cases[0]), "commented");
  EXPECT_EQ(case_hash(reordered), case_hash(cases[0]));
}

}  // namespace
}  // namespace rheocyte::write_case_test

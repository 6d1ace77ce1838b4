// A good case gives exactly the values that stand in it; defaults, --set and conditions act as documented.
#include "case/read_case.h"

#include <gtest/gtest.h>

#include "../refusal.h"
#include "case/user_error.h"

namespace rheocyte::read_case_test {
namespace {

const std::string shortest = R"(
[channel]
width_um = 20
[flow]
rate_ul_per_s = 0.04
viscosity_mPas = 15.0
[cell]
radius_um = 7.66
[cell.bulk]
young_modulus_kPa = 3.437
)";

Case read(const std::string& text, std::vector<std::string> settings = {}) {
  return parse_case(text, "case.toml", settings);
}

std::string refusal(const std::string& text, std::vector<std::string> settings = {}) {
  return test::refusal_of([&] { read(text, std::move(settings)); });
}

TEST(ReadCase, GivenValuesAreKeptAndTheOthersHaveTheirDefaults) {
  const Case c = read(shortest);
  EXPECT_EQ(c.channel.width_um, 20.0);
  EXPECT_FALSE(c.channel.radius_um);
  EXPECT_EQ(c.flow.rate_ul_per_s, 0.04);
  EXPECT_EQ(c.flow.law, LiquidLaw::newtonian);
  EXPECT_EQ(c.flow.viscosity_mPas, 15.0);
  EXPECT_FALSE(c.flow.exponent);
  EXPECT_EQ(c.flow.density_kg_per_m3, 1000.0);
  EXPECT_EQ(c.cell.radius_um, 7.66);
  EXPECT_EQ(c.cell.bulk.law, BulkLaw::neo_hookean);
  EXPECT_EQ(c.cell.bulk.young_modulus_kPa, 3.437);
  EXPECT_EQ(c.numerics.accuracy, 1e-4);
}

TEST(ReadCase, ASettingReplacesAKeyAndTheLastOneWins) {
  const Case c = read(shortest, {"cell.radius_um=6", " cell.bulk.law = \"linear\" ", "cell.radius_um=+5.5"});
  EXPECT_EQ(c.cell.radius_um, 5.5);
  EXPECT_EQ(c.cell.bulk.law, BulkLaw::linear);
}

TEST(ReadCase, ASettingThatChangesTheLawDropsTheKeysOfTheOtherLaw) {
  const Case c = read(shortest, {"flow.law=power-law", "flow.consistency_Pa_sn=0.4", "flow.exponent=0.6"});
  EXPECT_FALSE(c.flow.viscosity_mPas);
  EXPECT_EQ(c.flow.exponent, 0.6);
  EXPECT_EQ(c.flow.shear_rate_floor, 0.01);
}

TEST(ReadCase, ASettingOfOneAlternativeReplacesTheOther) {
  const Case c = read(shortest, {"channel.radius_um=10.94"});
  EXPECT_FALSE(c.channel.width_um);
  EXPECT_EQ(c.channel.radius_um, 10.94);
  EXPECT_NE(refusal(shortest, {"channel.radius_um=10.94", "channel.width_um=20"}).find("exclude each other"),
            std::string::npos);
}

TEST(ReadCase, AKeyOfTheFileWithoutEffectIsRefusedWhoeverSetTheRest) {
  EXPECT_NE(refusal(shortest + "c1_fraction = 0.3\n").find("has no effect"), std::string::npos);
  EXPECT_EQ(refusal(shortest + "c1_fraction = 0.3\n", {"cell.bulk.law=linear"}), "accepted");
  EXPECT_NE(refusal(shortest, {"cell.bulk.c1_fraction=0.3"}).find("has no effect"), std::string::npos);
}

TEST(ReadCase, TheStiffeningIsThatOfFungsLawAndOneWhereItIsNotGiven) {
  EXPECT_EQ(read(shortest, {"cell.bulk.law=fung"}).cell.bulk.stiffening, 1);
  EXPECT_EQ(read(shortest, {"cell.bulk.law=fung", "cell.bulk.stiffening=0"}).cell.bulk.stiffening, 0);
  EXPECT_FALSE(read(shortest).cell.bulk.stiffening);
  EXPECT_NE(refusal(shortest, {"cell.bulk.stiffening=1"}).find("cell.bulk.law is \"neo-hookean\""), std::string::npos);
  EXPECT_NE(refusal(shortest, {"cell.bulk.law=fung", "cell.bulk.stiffening=-0.1"}).find("outside its range 0 .. 100"),
            std::string::npos);
}

TEST(ReadCase, TheAreaConstantIsThatOfSkalaksLawAndOneWhereItIsNotGiven) {
  const std::string shell = "cell.cortex.modulus_mN_per_m=1", skalak = "cell.cortex.law=skalak";
  EXPECT_EQ(read(shortest, {skalak, shell}).cell.cortex.area_constant, 1);
  EXPECT_EQ(read(shortest, {skalak, shell, "cell.cortex.area_constant=1000"}).cell.cortex.area_constant, 1000);
  EXPECT_NE(refusal(shortest, {"cell.cortex.law=neo-hookean", shell, "cell.cortex.area_constant=1"})
                .find("cell.cortex.law is \"neo-hookean\""),
            std::string::npos);
  EXPECT_NE(refusal(shortest, {skalak, shell, "cell.cortex.area_constant=0"}).find("outside its range 0.01 .. 1000"),
            std::string::npos);
}

TEST(ReadCase, TheFormerNameOfAKeyIsRead) {
  const std::vector<std::string> settings{"cell.bulk.law=mooney-rivlin", "cell.bulk.mooney_share=0.3"};
  EXPECT_EQ(read(shortest, settings).cell.bulk.c1_fraction, 0.3);
}

TEST(ReadCase, TheEndsOfARangeBelongToIt) {
  EXPECT_EQ(refusal(shortest, {"numerics.accuracy=1e-7"}), "accepted");
  EXPECT_EQ(refusal(shortest, {"numerics.accuracy=0.1"}), "accepted");
  EXPECT_NE(refusal(shortest, {"numerics.accuracy=0.1000001"}), "accepted");
  EXPECT_EQ(refusal(shortest, {"flow.density_kg_per_m3=0"}), "accepted");
}

TEST(ReadCase, TheCellMustFitIntoTheTubeThatIsMeant) {
  EXPECT_EQ(refusal(shortest, {"cell.radius_um=10.55"}), "accepted");  // 0.9644 of 10.94 um
  EXPECT_NE(refusal(shortest, {"cell.radius_um=10.56"}).find("of the tube radius 10.94 um"), std::string::npos);
  EXPECT_EQ(refusal(shortest, {"cell.radius_um=10.56", "channel.width_um=30"}), "accepted");
}

TEST(ReadCase, ACellOffTheAxisIsSeenAlongItsOffsetAndDoesNotTouchTheWall) {
  const std::string square = "[channel]\nsection = \"square\"" + shortest.substr(shortest.find("]") + 1);
  EXPECT_TRUE(is_centred(read(square).cell));
  EXPECT_TRUE(is_centred(read(square, {"cell.offset_um=[0, 0]"}).cell));
  EXPECT_EQ(read(square, {"cell.offset_um=[0, -1.5]"}).cell.offset_um[1], -1.5);
  EXPECT_EQ(refusal(square, {"cell.offset_um=[1.5, 0]", "channel.camera_degree=90"}), "accepted");
  for (const auto& [settings, reason] :
       {std::pair<std::vector<std::string>, std::string>{{"cell.offset_um=[1.5, 0]"}, "channel.camera_degree = 90"},
        {{"cell.offset_um=[0, 1.5]", "channel.camera=diagonal"}, "leave channel.camera and channel.camera_degree out"},
        {{"cell.offset_um=[1, 1]"}, "no symmetry is left"},
        {{"cell.offset_um=[1]"}, "two numbers"},
        {{"cell.offset_um=[0, 1.9]"}, "at most 1.84 um"}})
    EXPECT_NE(refusal(square, settings).find(reason), std::string::npos) << refusal(square, settings);
  EXPECT_NE(refusal(shortest, {"cell.offset_um=[0, 1]"}).find("has no effect"), std::string::npos);
}

TEST(ReadCase, ARefusalIsOneLineHoweverLongTheInput) {
  const auto text =
      refusal(shortest + "\"" + std::string(100000, 'k') + "\\n\" = \"" + std::string(100000, 'v') + "\"\n");
  EXPECT_LT(text.size(), 1000u);
  EXPECT_EQ(text.find('\n'), std::string::npos);
}

}  // namespace
}  // namespace rheocyte::read_case_test

// The viscosity of a buffer is that of the field's programs, for every model, channel, flow rate and temperature.
#include "measurement/viscosity.h"

#include <cmath>

#include "case/user_error.h"
#include "measurement/reference_files.h"

namespace rheocyte::viscosity_test {
namespace {

// Sums and powers in another order than the source of the values: a few units of the last place.
constexpr double rounding = 1e-13;

void expect_near(double value, double expected, double relative, const std::string& what) {
  EXPECT_LE(std::abs(value - expected), relative * std::abs(expected)) << what << ": " << value << " for " << expected;
}

TEST(Viscosity, MeetsTheValuesThatThePublishedModelsAreKnownBy) {
  // dclab 0.71.10 at 24 degC for (width um, flow ul/s); all digits printed.
  const Buffer thin(Medium::methyl_cellulose_049, ViscosityModel::buyukurganci_2022);
  const Buffer thick(Medium::methyl_cellulose_059, ViscosityModel::buyukurganci_2022);
  expect_near(thin.viscosity({15, 0.016}, 24), 5.4001970145102955, rounding, "0.49 %, 15 um");
  expect_near(thin.viscosity({20, 0.04}, 24), 5.3024816031010324, rounding, "0.49 %, 20 um");
  expect_near(thin.viscosity({40, 0.60}, 24), 4.274170894950141, rounding, "0.49 %, 40 um");
  expect_near(thick.viscosity({15, 0.032}, 24), 4.799374333891269, rounding, "0.59 %, 15 um");
  expect_near(thick.viscosity({30, 0.16}, 24), 5.824144616254946, rounding, "0.59 %, 30 um");
  // Herold's table, printed to 0.1 mPa s.
  const Buffer herold_thin(Medium::methyl_cellulose_049, ViscosityModel::herold_2017);
  const Buffer herold_thick(Medium::methyl_cellulose_059, ViscosityModel::herold_2017);
  EXPECT_NEAR(herold_thin.viscosity({20, 0.04}, 24), 5.7, 0.05);
  EXPECT_NEAR(herold_thick.viscosity({15, 0.016}, 24), 7.5, 0.05);
  // 23 degC, printed to 1e-4.
  EXPECT_NEAR(herold_thick.viscosity({30, 0.16}, 23), 7.1251, 5e-5);
  EXPECT_NEAR(Buffer(Medium::methyl_cellulose_083, ViscosityModel::buyukurganci_2022).viscosity({20, 0.06}, 23), 6.9247,
              5e-5);
}

TEST(Viscosity, OfWaterIsThatOfTheTablesOfKestin) {
  const Buffer water(Medium::water, ViscosityModel::kestin_1978);
  const double expected[] = {1.7915, 1.5193, 1.3070, 1.1383, 1.0020, .8902, .7973, .7191, .6527};
  // The correlation itself departs from the table by up to 8e-5.
  for (int i = 0; i < 9; ++i) expect_near(water.viscosity({20, 0.04}, 5 * i), expected[i], 8e-5, "water");
  EXPECT_EQ(water.viscosity({20, 0}, 20), water.viscosity({30, 1}, 20)) << "water does not thin";
}

TEST(Viscosity, MeetsEveryGoldenRow) {
  RHEOCYTE_NEED_REFERENCE("golden/viscosity.csv");
  const auto golden = test::read_csv(test::reference_folder() / "golden/viscosity.csv");
  ASSERT_EQ(golden.rows(), 480U);
  for (std::size_t i = 0; i < golden.rows(); ++i) {
    const auto medium = medium_of_name(golden.text("medium", i));
    const auto model = viscosity_model_of_name(golden.text("model", i));
    ASSERT_TRUE(medium && model) << golden.text("medium", i) << golden.text("model", i);
    const ChannelFlow flow{golden.number("channel_width_um", i), golden.number("flow_rate_uL_s", i)};
    expect_near(Buffer(*medium, *model).viscosity(flow, golden.number("temperature_C", i)),
                golden.number("viscosity_mPas", i), rounding, "row " + std::to_string(i));
  }
}

TEST(Viscosity, ManyTemperaturesGiveWhatEachGivesAlone) {
  const Buffer buffer(Medium::methyl_cellulose_059, ViscosityModel::buyukurganci_2022);
  const double temperatures[] = {21, 22.5, NAN, 24, INFINITY, 30, 37, 36, 35, 34, 33};
  double together[11];
  buffer.viscosity({20, 0.06}, temperatures, together);
  for (int i = 0; i < 11; ++i) {
    const double alone = buffer.viscosity({20, 0.06}, temperatures[i]);
    if (std::isfinite(temperatures[i]))
      expect_near(together[i], alone, rounding, "vectorised");
    else
      EXPECT_TRUE(std::isnan(alone) && std::isnan(together[i]));
  }
}

TEST(Viscosity, ConsistencyAndExponentInACaseGiveTheSameViscosityAtTheWall) {
  Case c;
  c.channel.width_um = 20;
  c.flow.rate_ul_per_s = 0.04;
  c.flow.law = LiquidLaw::power_law;
  for (const auto medium : {Medium::methyl_cellulose_049, Medium::methyl_cellulose_059, Medium::methyl_cellulose_083}) {
    const Buffer buffer(medium, ViscosityModel::buyukurganci_2022);
    c.flow.consistency_Pa_sn = buffer.consistency_Pa_sn(24);
    c.flow.exponent = buffer.flow_exponent(24);
    expect_near(channel_flow_of(c).viscosity_mPas, buffer.viscosity({20, 0.04}, 24), 1e-12, "rounding of powers");
  }
  const Buffer water(Medium::water, ViscosityModel::kestin_1978);
  expect_near(1e3 * water.consistency_Pa_sn(24), water.viscosity({}, 24), rounding, "water");
}

TEST(Viscosity, WithoutFlowAThinningLiquidHasNone) {
  const Buffer buffer(Medium::methyl_cellulose_049, ViscosityModel::herold_2017);
  EXPECT_TRUE(std::isnan(buffer.viscosity({20, 0}, 23)));
  EXPECT_TRUE(std::isnan(buffer.viscosity({20, NAN}, 23)));
}

TEST(Viscosity, MediaAreKnownByAllTheirNames) {
  EXPECT_EQ(medium_of_name(" CellCarrier "), Medium::methyl_cellulose_049) << "blanks around it do not count";
  for (const char* name : {"CellCarrier", "cellcarrier", "0.49% MC-PBS", "0.5%", "0.50%", "0.5% MC-PBS"})
    EXPECT_EQ(medium_of_name(name), Medium::methyl_cellulose_049) << name;
  for (const char* name : {"CellCarrierB", "CellCarrier B", "0.59% MC-PBS", "0.6%", "0.60%"})
    EXPECT_EQ(medium_of_name(name), Medium::methyl_cellulose_059) << name;
  for (const char* name : {"0.83% MC-PBS", "0.8%", "0.80%"})
    EXPECT_EQ(medium_of_name(name), Medium::methyl_cellulose_083) << name;
  EXPECT_EQ(medium_of_name("Water"), Medium::water);
  for (const char* name : {"other", "", "CellCarrierC", "%"}) EXPECT_FALSE(medium_of_name(name)) << name;
}

TEST(Viscosity, SolutionsAreKnownByTheirPercentageHoweverItIsWritten) {
  for (const char* name :
       {"0.60 % MC-PBS", "0,6% MC-PBS", "0.6%MC_PBS", "0.6% (w/v) MC in PBS", "0.6% Methyl cellulose", "MC-PBS 0.59 %",
        "0.600% methylcellulose in 1x PBS", "Cell Carrier B", "cell_carrier-b"})
    EXPECT_EQ(medium_of_name(name), Medium::methyl_cellulose_059) << name;
  for (const char* name : {"0,5 % MC/PBS", "Cell Carrier", "0.490% mc pbs"})
    EXPECT_EQ(medium_of_name(name), Medium::methyl_cellulose_049) << name;
  EXPECT_EQ(medium_of_name(".83% MC"), Medium::methyl_cellulose_083);
  for (const char* name : {"0.7% MC-PBS", "6% MC-PBS", "-0.6% MC-PBS", "0.6% alginate", "0.5% MC, 0.1% BSA",
                           "0.6 MC-PBS", "inf% MC-PBS", "0.6% PBS", "0% MC-PBS"})
    EXPECT_FALSE(medium_of_name(name)) << name;
}

TEST(Viscosity, AnUnknownSolutionIsNearTheOneOfTheNearestPercentage) {
  EXPECT_EQ(near_medium("0.62% MC-PBS"), ", did you mean 0.59% MC-PBS?");
  EXPECT_EQ(near_medium("0.52 % MC-PBS"), ", did you mean 0.49% MC-PBS?");
  EXPECT_EQ(near_medium("0.9% MC"), ", did you mean 0.83% MC-PBS?");
  EXPECT_EQ(near_medium("alginate 0.6%"), "") << "another polymer";
  EXPECT_EQ(medium_of_name("0.49 wt% MC-PBS"), Medium::methyl_cellulose_049);
  EXPECT_EQ(near_medium("10% MC-PBS"), "");
  EXPECT_EQ(near_medium("Cellcarier"), ", did you mean CellCarrier?");
  EXPECT_EQ(near_medium("ketchup"), "");
}

TEST(Viscosity, AModelThatDoesNotKnowTheMediumIsRefused) {
  EXPECT_THROW(Buffer(Medium::methyl_cellulose_083, ViscosityModel::herold_2017), UserError);
  EXPECT_THROW(Buffer(Medium::methyl_cellulose_049, ViscosityModel::kestin_1978), UserError);
  EXPECT_EQ(Buffer(Medium::water, ViscosityModel::herold_2017).model(), ViscosityModel::kestin_1978);
}

}  // namespace
}  // namespace rheocyte::viscosity_test

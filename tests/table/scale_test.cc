// Scaling there and back changes nothing, it commutes with the formulas of the field, and doubts are reported.
#include "table/scale.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "case/case_keys.h"
#include "case/problem.h"
#include "case/scales.h"
#include "case/unit.h"
#include "case/write_case.h"

namespace rheocyte::scale_test {
namespace {

TableText table_with(nlohmann::ordered_json more = {}) {
  TableText table;
  table.metadata = {{"channel_width", 20.0},           {"channel_width_unit", "um"}, {"flow_rate", 0.04},
                    {"flow_rate_unit", "uL/s"},        {"fluid_density", 1000.0},    {"fluid_viscosity", 15.0},
                    {"fluid_viscosity_unit", "mPa s"}, {"identifier", "XX-2D-26"}};
  for (const auto& [key, value] : more.items()) table.metadata[key] = value;
  table.rows = {{36.4233, 0.108169, 0.740832}, {290, 0.03, 11.46}};
  return table;
}

TEST(Scale, FollowsTheFormulaOfTheField) {
  // dclab: area (W/W0)^2, E (Q/Q0) (eta/eta0) (W0/W)^3.
  const auto out = scaled(table_with(), {30, 0.16, 5.0731}, "0");
  const double modulus = 0.16 / 0.04 * 5.0731 / 15 * 8.0 / 27;
  EXPECT_NEAR(out.rows[0][0] / (36.4233 * 2.25), 1, 1e-15);
  EXPECT_EQ(out.rows[0][1], 0.108169);
  EXPECT_NEAR(out.rows[0][2] / (0.740832 * modulus), 1, 1e-15);
  EXPECT_EQ(out.metadata.at("channel_width"), 30);
  EXPECT_EQ(out.metadata.at("fluid_viscosity"), 5.0731);
}

TEST(Scale, ThereAndBackIsTheSameTable) {
  for (const auto abscissa : {Abscissa::area, Abscissa::volume})
    for (const auto* stiffness : {"cell.bulk.young_modulus_kPa", "cell.cortex.modulus_mN_per_m"}) {
      auto table =
          table_with({{"stiffness", stiffness}, {"case", {{"cell", {{"cortex", {{"tension_mN_per_m", 0.3}}}}}}}});
      table.abscissa = abscissa;
      const auto back = scaled(scaled(table, {31, 0.07, 4}, "0"), channel_flow_of(table), "0");
      for (std::size_t i = 0; i < 2; ++i)
        for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(back.rows[i][k] / table.rows[i][k], 1, 1e-14);  // rounding
      EXPECT_NEAR(back.metadata["case"]["cell"]["cortex"]["tension_mN_per_m"].get<double>(), 0.3, 1e-15);
    }
}

TEST(Scale, KeepsTheDimensionlessGroups) {
  Case c;
  c.channel.width_um = 20;
  c.flow.rate_ul_per_s = 0.04;
  c.flow.viscosity_mPas = 15;
  c.cell.radius_um = 7;
  c.cell.bulk.young_modulus_kPa = 2;
  c.cell.cortex.modulus_mN_per_m = 31;
  const auto before = problem_of(c);
  const auto factor = scale_factors({20, 0.04, 15}, {33, 0.11, 4});
  c.channel.width_um = 33;
  c.flow.rate_ul_per_s = 0.11;
  c.flow.viscosity_mPas = 4;
  c.cell.radius_um *= std::sqrt(factor.area);
  *c.cell.bulk.young_modulus_kPa *= factor.modulus;
  *c.cell.cortex.modulus_mN_per_m *= factor.cortex_modulus;
  const auto after = problem_of(c);
  EXPECT_NEAR(after.radius_ratio / before.radius_ratio, 1, 1e-14);  // rounding
  EXPECT_NEAR(after.bulk.shear_modulus / before.bulk.shear_modulus, 1, 1e-14);
  EXPECT_NEAR(after.cortex.modulus / before.cortex.modulus, 1, 1e-14);
}

// A case with every number that a case in time can have.
Case full_case() {
  Case c;
  c.channel.radius_um = 11;
  c.channel.profile = {{-50, 60}, {20, 11}, {}};
  c.flow.rate_ul_per_s = 0.04;
  c.flow.viscosity_mPas = 15;
  c.flow.density_kg_per_m3 = 0;
  c.cell.radius_um = 7;
  c.cell.bulk.law = BulkLaw::neo_hookean;
  c.cell.bulk.young_modulus_kPa = 2;
  c.cell.cortex.law = CortexLaw::linear;
  c.cell.cortex.modulus_mN_per_m = 31;
  c.cell.cortex.tension_mN_per_m = 0.3;
  c.cell.viscosity_mPas = 4;
  c.cell.density_kg_per_m3 = 0;
  c.time.scheme = TimeScheme::monolithic;
  c.time.end_us = 300;
  return c;
}

TEST(Scale, EveryNumberOfACaseScalesWithItsUnit) {
  // The scaled case is the same dimensionless problem, in other units; 1e-14 is rounding.
  const Case before = full_case();
  const auto out =
      scaled(table_with({{"case", to_json(before)}, {"regularised_beyond_area_um2", {100, 50}}}), {33, 0.11, 4}, "0");
  Case after = before;
  for (const auto& key : case_keys()) {
    std::string path = "/case/" + std::string(key.name);
    std::ranges::replace(path, '.', '/');
    const nlohmann::ordered_json::json_pointer place(path);
    if (!out.metadata.contains(place) || out.metadata.at(place).is_string()) continue;
    EXPECT_EQ(unit_of(key.name).symbol, key.unit) << key.name;
    const auto& value = out.metadata.at(place);
    key.set(after, value.is_array() ? Value(value.get<std::vector<double>>()) : Value(value.get<double>()));
  }
  const Problem a = problem_of(before), b = problem_of(after);
  EXPECT_NEAR(b.radius_ratio / a.radius_ratio, 1, 1e-14);
  EXPECT_NEAR(b.bulk.shear_modulus / a.bulk.shear_modulus, 1, 1e-14);
  EXPECT_NEAR(b.cortex.modulus / a.cortex.modulus, 1, 1e-14);
  EXPECT_NEAR(b.cortex.tension / a.cortex.tension, 1, 1e-14);
  EXPECT_NEAR(b.bulk.viscosity / a.bulk.viscosity, 1, 1e-14);
  EXPECT_NEAR(b.wall.x[0] / a.wall.x[0], 1, 1e-14);
  EXPECT_NEAR(b.wall.radius[0] / a.wall.radius[0], 1, 1e-14);
  EXPECT_NEAR(*after.time.end_us / scales_of(after).time_s() / (300 / scales_of(before).time_s()), 1, 1e-14);
  EXPECT_NEAR(out.metadata["regularised_beyond_area_um2"][1].get<double>() / (50 * 33 * 33 / 400.0), 1, 1e-14);
}

TEST(Scale, ShearThinningLiquidsOfOneExponentScaleWithTheViscosityAtTheWall) {
  // S = K (U/R)^n and the viscosity at the wall K (Q/W^3)^(n-1) give the factor of the Newtonian formula.
  auto table = table_with({{"fluid_density", 0},
                           {"fluid_flow_behaviour_index", 0.6039},
                           {"fluid_consistency_coefficient", 0.4057},
                           {"case", {{"flow", {{"law", "power-law"}, {"consistency_Pa_sn", 0.4057}}}}}});
  const ChannelFlow to{30, 0.16, 9};
  const auto out = scaled(table, to, "0");
  const double K = out.metadata.at("fluid_consistency_coefficient"), n = 0.6039;
  const auto stress = [n](double k, const ChannelFlow& at) {
    return k * std::pow(at.rate_ul_s / std::pow(at.width_um, 3), n);
  };
  EXPECT_NEAR(out.rows[0][2] / table.rows[0][2], stress(K, to) / stress(0.4057, channel_flow_of(table)), 1e-13);
  EXPECT_EQ(out.metadata["case"]["flow"]["consistency_Pa_sn"], K);
  ASSERT_EQ(doubts_of_scaling(table, to).size(), 1u);
  EXPECT_NE(doubts_of_scaling(table, to)[0].find("shear-thinning"), std::string::npos);
}

TEST(Scale, DoubtsAreInertiaAndBendingWhereTheyMatter) {
  EXPECT_TRUE(doubts_of_scaling(table_with(), {20, 0.04, 15}).empty());
  EXPECT_TRUE(doubts_of_scaling(table_with(), {25, 0.04, 15}).empty());  // Reynolds number from 0.078 to 0.062
  ASSERT_EQ(doubts_of_scaling(table_with(), {20, 0.12, 5}).size(), 1u);  // to 0.70
  EXPECT_NE(doubts_of_scaling(table_with(), {20, 0.12, 5})[0].find("inertia changes the deformation by about 0.8 %"),
            std::string::npos);
  EXPECT_TRUE(doubts_of_scaling(table_with({{"fluid_density", 0}}), {20, 0.12, 5}).empty());
  const auto bent = table_with({{"regularised_rows", 7}, {"fluid_density", 0}});
  EXPECT_TRUE(doubts_of_scaling(bent, {25, 0.04, 15}).empty());  // c_b / (eta Q) is what counts
  EXPECT_EQ(doubts_of_scaling(bent, {20, 0.08, 15}).size(), 1u);
  const auto alike = table_with({{"regularised_rows", 7}, {"fluid_density", 0}, {"bending_beyond_ratio", 3e-5}});
  EXPECT_TRUE(doubts_of_scaling(alike, {20, 0.08, 15}).empty());
  const auto text = scaled(bent, {20, 0.08, 15}, "0").comments;
  EXPECT_NE(text[1].find("Not exact: its bending stiffness"), std::string::npos);
}

}  // namespace
}  // namespace rheocyte::scale_test

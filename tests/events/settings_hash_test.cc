// The hash of settings is that of what decides the numbers, and of nothing else.
#include "events/settings_hash.h"

#include <gtest/gtest.h>

#include <set>

namespace rheocyte::settings_hash_test {
namespace {

ExtractSettings settings() {
  ExtractSettings s;
  s.conditions.flow = {.width_um = 20, .rate_ul_s = 0.04, .viscosity_mPas = 15};
  s.conditions.pixel_size_um = 0.34;
  return s;
}

std::string hash_of(const ExtractSettings& settings, const GateOptions& gates = {}) {
  return settings_hash(decisive_lines(settings, Gates(gates)));
}

TEST(SettingsHash, IsThatOfTheLinesInTheirOrder) {
  const std::vector<std::string> lines{"table: A", "b"}, same{"table: A", "b"}, turned{"b", "table: A"},
      joined{"table: Ab"};
  EXPECT_EQ(settings_hash(lines).size(), 16U);
  EXPECT_EQ(settings_hash(lines), settings_hash(same));
  EXPECT_NE(settings_hash(lines), settings_hash(turned));
  EXPECT_NE(settings_hash(lines), settings_hash(joined));
}

TEST(SettingsHash, OfOtherSettingsIsAnother) {
  std::set<std::string> hashes{hash_of(settings())};
  const auto expect_another = [&](const ExtractSettings& other, const GateOptions& gates, const char* what) {
    EXPECT_TRUE(hashes.insert(hash_of(other, gates)).second) << what;
  };
  ExtractSettings other = settings();
  other.conditions.flow.viscosity_mPas = 15.01;
  expect_another(other, {}, "viscosity");
  other = settings();
  other.conditions.flow.rate_ul_s = 0.06;
  expect_another(other, {}, "flow rate");
  other = settings();
  other.conditions.correct_area = !other.conditions.correct_area;
  expect_another(other, {}, "correction");
  other = settings();
  other.buffer.emplace(*medium_of_name("CellCarrier"), ViscosityModel::buyukurganci_2022);
  expect_another(other, {}, "medium");
  expect_another(settings(), {.min = {"area_um=40"}, .max = {}}, "limit");
  expect_another(settings(), {.min = {"area_um=41"}, .max = {}}, "another limit");
  expect_another(settings(), {.min = {}, .max = {"area_um=40"}}, "limit above");
  expect_another(settings(), {.min = {}, .max = {}, .polygons = {"area_um,deform=40,0:90,0:90,0.1"}}, "polygon");
  expect_another(settings(), {.min = {}, .max = {}, .polygons = {"area_um,deform=40,0:90,0:90,0.2"}}, "other corners");
  expect_another(settings(), {.min = {}, .max = {}, .polygons = {}, .events = {{1, 2}}}, "chosen events");
  expect_another(settings(), {.min = {}, .max = {}, .polygons = {}, .events = {{1, 3}}}, "other events");
}

TEST(SettingsHash, IsNotThatOfAMeasuredTemperature) {
  ExtractSettings one = settings();
  one.buffer.emplace(*medium_of_name("CellCarrier"), ViscosityModel::buyukurganci_2022);
  one.temperature_from = TemperatureSource::metadata;
  one.temperature_C = 23;
  ExtractSettings other = one;
  other.temperature_C = 23.4;
  other.conditions.flow.viscosity_mPas = 14.9;
  EXPECT_EQ(hash_of(one), hash_of(other));
  one.temperature_from = other.temperature_from = TemperatureSource::given;
  EXPECT_NE(hash_of(one), hash_of(other)) << "a temperature that is given is a setting";
}

}  // namespace
}  // namespace rheocyte::settings_hash_test

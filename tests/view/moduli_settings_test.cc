// Settings of a page are the options of `rheocyte extract`, and nothing else.
#include "view/moduli_settings.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "case/user_error.h"

namespace rheocyte::moduli_settings_test {
namespace {

using Json = nlohmann::ordered_json;

std::filesystem::path no_tables(std::size_t) { throw UserError("no table"); }

void expect_refusal(const Json& settings, const std::string& words) {
  try {
    static_cast<void>(extract_options(settings, no_tables));
    FAIL() << settings << " was taken";
  } catch (const UserError& error) {
    EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
  }
}

TEST(ModuliSettings, BecomeOptionsAndTheCommandWithTheSameNumbers) {
  const Json settings{{"table", "LE-2D-26"},    {"medium", "0.59% MC-PBS"},   {"temperature", 23.5},
                      {"channel_width_um", 30}, {"max", {"area_ratio=1.05"}}, {"no_asymmetry", true},
                      {"no_pixelation", false}, {"viscosity_model", nullptr}};
  const ExtractOptions options = extract_options(settings, no_tables);
  EXPECT_EQ(options.table, "LE-2D-26");
  EXPECT_EQ(options.measuring.medium, "0.59% MC-PBS");
  EXPECT_EQ(options.measuring.temperature, "23.5");
  EXPECT_EQ(options.measuring.channel_width_um, 30.0);
  EXPECT_TRUE(options.no_asymmetry);
  EXPECT_FALSE(options.no_pixelation || options.measuring.viscosity_model);
  EXPECT_EQ(extract_command(options, "/data/it's a.rtdc"),
            "rheocyte extract '/data/it'\\''s a.rtdc' --table LE-2D-26 --channel-width-um 30 --medium '0.59% MC-PBS' "
            "--temperature 23.5 --max area_ratio=1.05 --no-asymmetry");
  EXPECT_EQ(moduli_command(moduli_options(options, "/tables/mine"), "a.rtdc"),
            "rheocyte moduli a.rtdc --table /tables/mine --channel-width-um 30 --medium '0.59% MC-PBS' --temperature "
            "23.5 --max area_ratio=1.05");
}

TEST(ModuliSettings, ComeBackFromAProcessOfOurOwn) {
  const Json settings{{"table", "LE-2D-26"},     {"flow_rate_ul_s", 0.04}, {"pixel_size_um", 0.34},
                      {"viscosity_mPas", 5.125}, {"min", {"area_um=40"}},  {"max", {"area_um=90"}},
                      {"patience", 5.0},         {"no_pixelation", true},  {"no_area_correction", true}};
  EXPECT_EQ(all_settings(options_of_settings(settings)), settings);
  EXPECT_EQ(all_settings(ExtractOptions()), Json::object());
  EXPECT_EQ(all_settings(options_of_settings({{"section", "tube"}})), Json({{"section", "tube"}}));
}

TEST(ModuliSettings, TakeTablesByIdentifierOrItemAndNeverByPath) {
  const auto options = extract_options({{"table", 3}}, [](std::size_t number) {
    EXPECT_EQ(number, 3u);
    return std::filesystem::path("/tables/mine");
  });
  EXPECT_EQ(options.table, "/tables/mine");
  for (const char* path : {"/etc/passwd", "../table", "data/grid_LE-2D-26.cbor", "LE-2D-26/"})
    expect_refusal({{"table", path}}, "LE-2D-26, LE-2D-MC049-26");
  expect_refusal({{"table", -1}}, "the number of an item");
}

TEST(ModuliSettings, PolygonsAreNeverReadFromFiles) {
  expect_refusal({{"polygon", {"/data/filters.poly"}}}, "features and corners, not a file");
}

TEST(ModuliSettings, ThatAreWrongAreNamed) {
  expect_refusal({{"output", "/tmp"}}, "no setting output");
  expect_refusal({{"channel_width_um", "20"}}, "channel_width_um must be a number");
  expect_refusal({{"channel_width_um", -20}}, "channel_width_um -20 is outside its range 1 .. 10000 um");
  expect_refusal({{"section", "round"}}, "section must be tube or square");
  expect_refusal({{"section", "tube"}, {"table", "LE-2D-26"}}, "--table and --section contradict each other");
  expect_refusal({{"patience", 0}}, "patience 0 is outside its range");
  expect_refusal({{"pixel_size_um", 0}}, "pixel_size_um");
  expect_refusal({{"max", "area_um=40"}}, "list of texts");
  expect_refusal({{"min", {"area_um"}}}, "give a feature and a number");
  expect_refusal({{"no_asymmetry", 1}}, "true or false");
  expect_refusal({{"viscosity_mPas", 5}, {"medium", "water"}}, "contradict");
  expect_refusal(Json::array(), "must be an object");
}

}  // namespace
}  // namespace rheocyte::moduli_settings_test

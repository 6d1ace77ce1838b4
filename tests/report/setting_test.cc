// A setting is declared once: what may be given, where it goes, and how it is written for others.
#include "events/setting.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>

#include "case/user_error.h"
#include "events/recording_settings.h"
#include "report/settings_text.h"

namespace rheocyte::setting_test {
namespace {

using Json = nlohmann::ordered_json;

Setting named(const Settings& settings, std::string_view name) {
  for (const Setting& setting : settings)
    if (setting.name == name) return setting;
  ADD_FAILURE() << name;
  return {};
}

std::string refusal(const std::function<void()>& work) {
  try {
    work();
  } catch (const UserError& error) {
    return error.what();
  }
  return "taken";
}

TEST(Settings, OfEachCommandHaveNamesOfTheirOwnASentenceAndALabel) {
  ExtractOptions extract;
  ModuliOptions moduli;
  TimeCourseOptions course;
  FeaturesOptions features;
  for (const Settings& settings :
       {settings_of(extract), settings_of(moduli), settings_of(course), settings_of(features)}) {
    std::set<std::string_view> names;
    for (const Setting& setting : settings) {
      EXPECT_TRUE(names.insert(setting.name).second) << setting.name;
      EXPECT_FALSE(setting.sentence.empty() || setting.label.empty()) << setting.name;
      EXPECT_FALSE(value_of(setting)) << setting.name << " is given before anybody gives it";
    }
  }
}

TEST(Settings, AreNotEmpty) {
  ExtractOptions options;
  for (const Json& given :
       {Json{{"medium", ""}}, Json{{"temperature", " "}}, Json{{"table", ""}}, Json{{"max", {"area_um=90", ""}}}})
    EXPECT_EQ(refusal([&] { take_settings(settings_of(options), given); }),
              given.begin().key() + " is empty; give a value, or leave it out.");
}

TEST(Settings, GoToTheirPlaces) {
  ExtractOptions options;
  take_settings(settings_of(options), {{"section", "tube"},
                                       {"temperature", 23},
                                       {"flow_rate_ul_s", 0.04},
                                       {"medium", nullptr},
                                       {"patience", 5},
                                       {"min", {"area_um=40"}},
                                       {"no_asymmetry", true}});
  EXPECT_EQ(options.section, Section::tube);
  EXPECT_EQ(options.measuring.temperature, "23");
  EXPECT_EQ(options.measuring.flow_rate_ul_s, 0.04);
  EXPECT_EQ(options.measuring.medium, std::nullopt);
  EXPECT_EQ(options.measuring.patience_s, 5.0);
  EXPECT_EQ(options.measuring.gates.min, std::vector<std::string>{"area_um=40"});
  EXPECT_TRUE(options.no_asymmetry);
}

TEST(Settings, ComeBackAsJsonAndAsOptions) {
  const Json given{{"table", "LE-2D-26"},
                   {"channel_width_um", 30.0},
                   {"medium", "0.59% MC-PBS"},
                   {"max", {"area_ratio=1.05", "deform=0.1"}},
                   {"no_pixelation", true}};
  ExtractOptions options;
  take_settings(settings_of(options), given);
  EXPECT_EQ(given_settings(settings_of(options)), given);
  EXPECT_EQ(options_text(settings_of(options)),
            " --table LE-2D-26 --channel-width-um 30 --medium '0.59% MC-PBS' --max area_ratio=1.05 --max deform=0.1 "
            "--no-pixelation");
}

TEST(Settings, OfAnotherKindOrOutsideTheirRangeAreRefusedByName) {
  ExtractOptions options;
  const Settings settings = settings_of(options);
  const auto why = [&](const Json& given) { return refusal([&] { take_settings(settings, given); }); };
  EXPECT_EQ(why({{"channel_width_um", 0}}),
            "channel_width_um 0 is outside its range 1 .. 10000 um (width of the channel).");
  EXPECT_EQ(why({{"channel_width_um", "wide"}}), "channel_width_um must be a number.");
  EXPECT_EQ(why({{"medium", true}}), "medium must be a text.");
  EXPECT_EQ(why({{"section", "round"}}), "section must be tube or square.");
  EXPECT_EQ(why({{"no_pixelation", 1}}), "no_pixelation must be true or false.");
  EXPECT_EQ(why({{"min", "area_um=40"}}), "min must be a list of texts.");
  EXPECT_EQ(why({{"min", Json::object()}}), "min must be a number, a text, a list of texts, or true or false.");
  EXPECT_EQ(why({{"output", "/tmp"}}), "There is no setting output.");
  EXPECT_EQ(refusal([&] { take(named(settings, "patience"), NAN, "rheocyte: --patience"); }).substr(0, 36),
            "rheocyte: --patience nan is outside ");
}

TEST(Settings, AreDeclaredWithAllThatAFieldNeeds) {
  ExtractOptions options;
  const Json declared = declared_settings(settings_of(options));
  const auto of = [&](std::string_view name) {
    return *std::ranges::find_if(declared, [&](const Json& one) { return one["name"] == name; });
  };
  EXPECT_EQ(of("channel_width_um")["kind"], "number");
  EXPECT_EQ(of("channel_width_um")["greatest"], 10000);
  EXPECT_EQ(of("channel_width_um")["option"], "--channel-width-um");
  EXPECT_EQ(of("temperature")["kind"], "number");
  EXPECT_EQ(of("temperature")["words"], Json({"feature", "metadata"}));
  EXPECT_EQ(of("temperature")["greatest"], nullptr);
  EXPECT_EQ(of("section")["kind"], "choice");
  EXPECT_EQ(of("polygon")["kind"], "texts");
  EXPECT_EQ(of("no_pixelation")["kind"], "flag");
}

}  // namespace
}  // namespace rheocyte::setting_test

// The settings of a plan: their defaults stand where their values go.
#include "experiment/plan_settings.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "case/user_error.h"
#include "report/settings_text.h"

namespace rheocyte::plan_settings_test {
namespace {

using Json = nlohmann::ordered_json;

TEST(PlanSettings, SayWhatHoldsUnlessTheyAreGiven) {
  PlanOptions options;
  std::map<std::string, Json> declared;
  for (const Json& each : declared_settings(settings_of(options))) declared[each["name"]] = each;
  EXPECT_EQ(declared["spread"]["default"], "0.2");
  EXPECT_EQ(declared["width_um"]["default"], "15, 20, 30");
  EXPECT_EQ(declared["width_um"]["kind"], "numbers");
  EXPECT_EQ(declared["medium"]["default"], "0.49% MC-PBS, 0.83% MC-PBS");
  EXPECT_EQ(declared["radius_um"]["default"], "") << "must be given";
  EXPECT_TRUE(std::isnan(options.radius_um));
}

TEST(PlanSettings, GoToTheirPlacesOrAreRefusedByName) {
  PlanOptions options;
  const Settings settings = settings_of(options);
  take_settings(settings, {{"spread", 0.1}, {"width_um", {20, 30}}, {"medium", {"water"}}});
  EXPECT_EQ(options.spread, 0.1);
  EXPECT_EQ(options.widths_um, (std::vector<double>{20, 30}));
  EXPECT_EQ(options.media, std::vector<std::string>{"water"});
  for (const Json& wrong : {Json{{"width_um", {20, 0}}}, Json{{"spread", 5}}, Json{{"width_um", {"wide"}}}}) try {
      take_settings(settings, wrong);
      ADD_FAILURE() << wrong;
    } catch (const UserError& error) {
      EXPECT_TRUE(std::string(error.what()).starts_with(wrong.begin().key())) << error.what();
    }
}

}  // namespace
}  // namespace rheocyte::plan_settings_test

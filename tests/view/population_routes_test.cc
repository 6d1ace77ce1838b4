// Requests for populations: whatever a body holds, the answer is a sentence about it.
#include <gtest/gtest.h>

#include <array>
#include <nlohmann/json.hpp>
#include <optional>

#include "case/json_guard.h"
#include "measurement/recording_writer.h"
#include "view/view_routes.h"
#include "virtual_cells.h"

namespace rheocyte::population_routes_test {
namespace {

using Json = nlohmann::ordered_json;

class PopulationRoute : public testing::Test {
 protected:
  PopulationRoute() {
    test::write_virtual_cells(folder_ / "cells, 5 %.rtdc", 12);
    const std::array<std::filesystem::path, 1> paths{folder_ / "cells, 5 %.rtdc"};
    routes_.emplace(paths, folder_ / "out");
  }
  Answer ask(const Json& body) const {
    return routes_->router().answer({.method = "POST", .path = "/api/population", .body = json_text(body)});
  }

  test::ScratchFolder folder_;
  std::optional<ViewRoutes> routes_;
};

TEST_F(PopulationRoute, BodiesOfAnyFormHaveASentenceAboutThem) {
  const Json condition{{"name", "a"}, {"items", {0}}};
  const auto with = [&condition](const char* name, const Json& value) {
    Json changed = condition;
    changed[name] = value;
    return Json{{"conditions", {changed}}};
  };
  std::vector<Json> bodies{Json::object(), Json::array(), 5, "a", nullptr};
  for (const Json& odd : {Json(5), Json(-1), Json(0.5), Json("x"), Json(true), Json(nullptr), Json::array({"x"}),
                          Json::array({Json::array()}), Json{{"a", 5}}}) {
    bodies.push_back({{"conditions", odd}});
    bodies.push_back({{"conditions", Json::array({odd})}});
    bodies.push_back(with("name", odd));
    bodies.push_back(with("items", odd));
    bodies.push_back(with("items", Json::array({odd})));
    bodies.push_back({{"conditions", {condition}}, {"settings", odd}});
    for (const char* const setting : {"polygon", "min", "model", "paired", "level", "temperature", "section"})
      bodies.push_back({{"conditions", {condition}}, {"settings", {{setting, odd}}}});
  }
  for (const Json& body : bodies) {
    const Answer answer = ask(body);
    EXPECT_TRUE(answer.status == 400 || answer.status == 404) << answer.status << ' ' << body << answer.body;
    EXPECT_EQ(answer.body.find("error of the program"), std::string::npos) << body << answer.body;
  }
}

TEST_F(PopulationRoute, ARecordingOfTooFewCellsIsNamedWithItsCommas) {
  const Answer answer = ask({{"conditions", {{{"name", "a"}, {"items", {0}}}}}});
  EXPECT_EQ(answer.status, 400) << answer.body;
  EXPECT_NE(answer.body.find("at least 20"), std::string::npos) << answer.body;
}

}  // namespace
}  // namespace rheocyte::population_routes_test

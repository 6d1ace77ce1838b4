// Every name in the files of a result stands in their reference, and the reference in docs is up to date.
#include "result/result_reference.h"

#include <gtest/gtest.h>

#include <fstream>
#include <set>
#include <sstream>
#include <string>

#include "case/read_case.h"
#include "case/scales.h"
#include "result/result.h"
#include "result/time_record.h"

namespace rheocyte::result_reference_test {
namespace {

using Names = std::set<std::string>;

/// The names that the sections with these titles explain.
Names explained(const Names& titles) {
  Names names;
  std::istringstream text(result_reference(true));
  std::string line, title;
  while (std::getline(text, line)) {
    if (line.starts_with("## ")) title = line.substr(3);
    if (line.starts_with("| `") && titles.contains(title)) names.insert(line.substr(3, line.find('`', 3) - 3));
  }
  return names;
}

Names keys(const nlohmann::ordered_json& object) {
  Names names;
  for (const auto& [key, value] : object.items()) names.insert(key);
  return names;
}

Names columns(const std::string& csv) {
  Names names;
  std::istringstream head(csv.substr(0, csv.find('\n')));
  for (std::string name; std::getline(head, name, ',');) names.insert(name);
  return names;
}

nlohmann::ordered_json some_result() {
  const Case c = read_case(std::filesystem::path(EXAMPLES) / "paper-cell.toml", {});
  Result result{c, scales_of(c), problem_of(c), {}};
  result.state.branch = {{0.5, 0.01, 4, 4}};
  return to_json(result);
}

TEST(ResultReference, ExplainsEveryKeyOfResultJson) {
  const auto result = some_result();
  EXPECT_EQ(keys(result), explained({"result.json", "Measures in result.json", "Computation in result.json"}));
  EXPECT_EQ(keys(result["branch"][0]), explained({"branch in result.json"}));
  EXPECT_EQ(keys(result["statistics"]), explained({"statistics in result.json"}));
  EXPECT_EQ(keys(result["threads"]), explained({"threads in result.json"}));
  for (const auto& [key, value] : result.items())  // that of the case stands in the case reference
    EXPECT_TRUE(!value.is_object() || key == "case" || key == "statistics" || key == "threads" || key == "errors" ||
                key == "gradients")
        << key;
}

TEST(ResultReference, ExplainsEveryColumn) {
  EXPECT_EQ(columns(history_csv({})), explained({"history.csv"}));
  EXPECT_EQ(columns(contours_csv({})), explained({"contours.csv"}));
  Problem channel;
  channel.wall = {{0, 1}, {1, 1}};
  EXPECT_EQ(columns(channel_csv(channel, {})), explained({"channel.csv"}));
  const Case c = read_case(std::filesystem::path(EXAMPLES) / "paper-cell.toml", {});
  EXPECT_EQ(columns(contour_csv({}, scales_of(c))), explained({"contour.csv"}));
  EXPECT_EQ(columns(offset_outline_csv({}, scales_of(c))), explained({"contour_offset.csv"}));
}

TEST(ResultReference, InDocsIsUpToDate) {
  std::ostringstream text;
  text << std::ifstream(RESULT_REFERENCE).rdbuf();
  EXPECT_EQ(text.str(), result_reference(true))
      << "run `build/rheocyte help result --markdown > docs/result-reference.md`";
}

TEST(StateMeasures, HaveUniqueNamesAndASentence) {
  Names names;
  for (const auto& measure : state_measures) {
    EXPECT_TRUE(names.insert(std::string(measure.name)).second) << measure.name;
    EXPECT_FALSE(measure.sentence.empty()) << measure.name;
  }
}

TEST(StateMeasures, AreScaledByTheirUnits) {
  // A length of 1 is R = 10 um, an area of 1 is 100 um^2; velocities, rates, stresses and tensions go with U and S R.
  const Scales scales{1e-5, 0.2, 30};
  const auto one = [&](std::string_view name) { return dimensionless_one(unit_of(name), scales); };
  EXPECT_DOUBLE_EQ(one("perimeter_um"), 10);
  EXPECT_DOUBLE_EQ(one("area_um2"), 100);
  EXPECT_DOUBLE_EQ(one("volume_um3"), 1000);
  EXPECT_DOUBLE_EQ(one("cell_velocity_m_per_s"), 0.2);
  EXPECT_DOUBLE_EQ(one("flow_rate_ul_per_s"), 0.02);  // R^2 U = 2e-11 m^3/s
  EXPECT_DOUBLE_EQ(one("pressure_drop_Pa"), 30);
  EXPECT_DOUBLE_EQ(one("least_tension_mN_per_m"), 0.3);
  EXPECT_DOUBLE_EQ(one("rate_per_s"), 2e4);
  EXPECT_DOUBLE_EQ(one("t_us"), 50);
  EXPECT_EQ(one("deformation"), 1);
}

}  // namespace
}  // namespace rheocyte::result_reference_test

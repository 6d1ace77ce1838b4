// States, fields, ways in time, cases as text, exports and sessions, as a page or a script gets them.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "case/scales.h"
#include "cell_requests.h"
#include "result/result.h"
#include "solve/stationary.h"
#include "store/own_file.h"
#include "view/case_from_json.h"
#include "view/state_json.h"

namespace rheocyte::cell_routes_test {
namespace {

using namespace cell_requests;

class CellRoutes : public CellRequests {};

TEST_F(CellRoutes, AStateFromNothingHasAllDigitsOfTheSolver) {
  for (const double modulus : {2.5, 8.0}) {
    const Case c = case_from_json(cell(modulus));
    Result result{c, scales_of(c), problem_of(c), solve_stationary(problem_of(c))};
    const Json wanted = Json::parse(to_json(result).dump()), got = json("/api/state", cell(modulus));
    for (const auto& measure : state_measures) EXPECT_EQ(got[measure.name], wanted[measure.name]) << measure.name;
    EXPECT_EQ(got["case_hash"], wanted["case_hash"]);
    EXPECT_EQ(got["branch"], wanted["branch"]);
  }
}

TEST_F(CellRoutes, AWarmStateIsTheSameWithinTheToleranceOfNewton) {
  json("/api/state", cell(4), {{"stream", "s"}});
  const Json warm = json("/api/state", cell(4.1), {{"stream", "s"}}), cold = json("/api/state", cell(4.1));
  EXPECT_NEAR(warm["deformation"].get<double>() / cold["deformation"].get<double>(), 1, 1e-8);
}

/// What two answers say of a state differs by no more than rounding, or by the stated error.
void expect_same_numbers(const Json& warm, const Json& cold) {
  for (const StateMeasure& measure : state_measures) {
    const Json &a = warm[measure.name], &b = cold[measure.name];
    EXPECT_EQ(a.is_null(), b.is_null()) << measure.name;
    if (a.is_null() || b.is_null()) continue;
    const double stated = warm["errors"][measure.name].get<double>(), value = b.get<double>();
    EXPECT_NEAR(a.get<double>(), value, std::max(stated, 1e-9 * std::abs(value))) << measure.name;
  }
  const auto pressures = [](const Json& state) { return floats(state["fields"]["values"]["pressure_Pa"]); };
  const std::vector<float> a = pressures(warm), b = pressures(cold);
  if (a.size() != b.size()) return;  // another mesh
  double greatest = 0, difference = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    greatest = std::max<double>(greatest, std::abs(b[i]));
    difference = std::max<double>(difference, std::abs(a[i] - b[i]));
  }
  EXPECT_LT(difference, 1e-5 * greatest);  // single precision, and Newton's tolerance
}

TEST_F(CellRoutes, AStreamInWhichTheRadiusChangesHasTheNumbersOfStatesFromNothing) {
  // With it the length of the channel changes, and so do the pressures at its ends.
  Json moved = cell();
  for (const double radius : {6.9, 6.7, 6.0, 3.0, 3.2}) {
    SCOPED_TRACE(radius);
    moved["cell"]["radius_um"] = radius;
    const Json warm = json("/api/state", moved, {{"stream", "s"}, {"fields", "1"}});
    expect_same_numbers(warm, json("/api/state", moved, {{"fields", "1"}}));
  }
}

TEST_F(CellRoutes, TheAccuracyOfARequestReplacesThatOfTheCase) {
  const Json state = json("/api/state", cell(), {{"accuracy", "1e-2"}});
  EXPECT_EQ(state["case"]["numerics"]["accuracy"], 1e-2);
  EXPECT_EQ(post("/api/state", cell(), {{"accuracy", "fine"}}).status, 400);
}

/// From a kept state, whose factors are those of another one nearby, as from nothing.
TEST_F(CellRoutes, GradientsComeWhereTheyAreAskedFor) {
  const std::string key = "cell.bulk.young_modulus_kPa";
  EXPECT_TRUE(json("/api/state", cell())["gradients"].empty());
  const Json cold = json("/api/state", cell(4.1), {{"gradient", key}});
  json("/api/state", cell(4), {{"stream", "s"}});
  const Json warm = json("/api/state", cell(4.1), {{"stream", "s"}, {"gradient", key + ",cell.radius_um"}});
  EXPECT_EQ(cold["gradients"].size(), 1);
  EXPECT_EQ(warm["gradients"].size(), 2);
  const double slope = cold["gradients"][key]["deformation"].get<double>();
  EXPECT_LT(slope, 0);
  EXPECT_NEAR(warm["gradients"][key]["deformation"].get<double>() / slope, 1, 1e-5);
  EXPECT_GT(json("/api/state", cell(), {{"gradient", "all"}})["gradients"].size(), 6);
  const Answer refused = post("/api/state", cell(), {{"gradient", "cell.radius"}});
  EXPECT_EQ(refused.status, 400);
  EXPECT_NE(refused.body.find("did you mean cell.radius_um"), std::string::npos);
}

TEST_F(CellRoutes, OutlinesAreClosedAboutTheirCentroidAndFieldsFitToThem) {
  const Json state = json("/api/state", cell(), {{"fields", "1"}});
  for (const char* name : {"contour", "hull"}) {
    const auto x = state[name]["x_um"].get<std::vector<double>>(), r = state[name]["r_um"].get<std::vector<double>>();
    EXPECT_EQ(x.front(), x.back());
    EXPECT_EQ(r.front(), r.back());
  }
  const Json& fields = state["fields"];
  const auto points = fields["points"].get<std::size_t>();
  const auto xy = floats(fields["xy_um"]), stretch = floats(fields["values"]["stretch"]);
  ASSERT_EQ(xy.size(), 2 * points);
  ASSERT_EQ(stretch.size(), points);
  EXPECT_EQ(floats(fields["index"]).size(), 3 * fields["triangles"].get<std::size_t>());
  for (const char* name : {"speed_m_per_s", "pressure_Pa", "shear_rate_per_s", "stress_Pa"})
    EXPECT_EQ(floats(fields["values"][name]).size(), points) << name;
  std::string region;
  ASSERT_TRUE(decode_base64(fields["region"].get<std::string>(), region));
  ASSERT_EQ(region.size(), points);
  double front = -1e9, greatest = 0;
  for (std::size_t i = 0; i < points; ++i) {
    if (region[i] == 0) continue;
    front = std::max<double>(front, xy[2 * i]);
    greatest = std::max<double>(greatest, stretch[i]);
  }
  EXPECT_NEAR(front, state["contour"]["x_um"][0].get<double>(), 1e-4);  // 32-bit numbers
  EXPECT_GT(greatest, 1);
}

TEST_F(CellRoutes, TheCommandOfACaseHoldsTheCase) {
  const std::string command = json("/api/case/text", cell())["command"];
  const std::size_t begin = command.find('\n') + 1;
  EXPECT_EQ(command.substr(0, begin), "rheocyte solve /dev/stdin -o result <<'END'\n");
  ASSERT_TRUE(command.ends_with("\nEND"));
  const std::string toml = command.substr(begin, command.size() - begin - 3);
  const Json read = json("/api/case/read", {{"toml", toml}});
  EXPECT_EQ(read["case"], json("/api/state", cell())["case"]);
}

TEST(ShownState, FieldsWithoutBase64AreTheSameBytes) {
  const Case c = case_from_json(cell());
  const ShownState shown({c, scales_of(c), problem_of(c), solve_stationary(problem_of(c))});
  std::string body;
  shown.give_fields([&](std::string_view piece) {
    body += piece;
    return true;
  });
  const std::size_t head_end = body.find('\n') + 1;
  const Json head = Json::parse(body.substr(0, head_end)), wanted = Json::parse(shown.fields());
  EXPECT_EQ(head["wall"], wanted["wall"]);
  std::size_t at = head_end;
  for (const Json& array : head["arrays"]) {
    std::string bytes;
    const Json::json_pointer place("/" + array["name"].get<std::string>());
    ASSERT_TRUE(decode_base64(wanted[place].get<std::string>(), bytes));
    const std::size_t size = array["type"] == "uint8" ? 1 : 4;
    ASSERT_EQ(bytes.size(), size * array["count"].get<std::size_t>()) << array["name"];
    EXPECT_EQ((at - head_end) % size, 0U) << array["name"];
    EXPECT_TRUE(body.substr(at, bytes.size()) == bytes) << array["name"];
    at += bytes.size();
  }
  EXPECT_EQ(at, body.size());
}

TEST_F(CellRoutes, TheNumbersOfAStateDoNotWaitForItsFields) {
  const Answer answer = post("/api/state", cell(), {{"fields", "after"}});
  std::vector<std::string> pieces;
  answer.give_pieces([&](std::string_view piece) { return pieces.emplace_back(piece), true; });
  ASSERT_EQ(pieces.size(), 3U);  // numbers, names of the arrays, arrays
  EXPECT_TRUE(Json::parse(pieces[0]).contains("contour"));
  EXPECT_TRUE(Json::parse(pieces[1]).contains("arrays"));
  std::size_t sampled = 0;
  answer.give_pieces([&](std::string_view) { return ++sampled, false; });
  EXPECT_EQ(sampled, 1U);  // nothing is sampled for a client that has left
}

TEST_F(CellRoutes, TheGreatestShearRateOfTheFieldsIsThatOfTheResult) {
  // The fields are sampled on a grid and fitted: within 3 %; the result looks beside the cell alone.
  const Json state = json("/api/state", cell(), {{"fields", "1"}});
  double greatest = 0;
  for (const float rate : floats(state["fields"]["values"]["shear_rate_per_s"]))
    greatest = std::max<double>(greatest, rate);
  EXPECT_NEAR(greatest / state["shear_rate_max_per_s"].get<double>(), 1, 0.03);
}

TEST_F(CellRoutes, WhereThereIsNoStateTheNearestCaseHasOne) {
  const Answer none = post("/api/state", cell(0.8));
  ASSERT_EQ(none.status, 422) << none.body;
  const Json reason = Json::parse(none.body);
  EXPECT_EQ(reason["reason"], "no-state");
  EXPECT_GT(reason["last"]["reached"], 0);
  EXPECT_GT(reason["nearest"]["cell"]["bulk"]["young_modulus_kPa"], 0.8);
  EXPECT_EQ(post("/api/state", reason["nearest"]).status, 200);
}

TEST_F(CellRoutes, AWrongCaseIsRefusedWithItsKey) {
  Json wrong = cell();
  wrong["cell"]["radius_um"] = 70;
  Answer answer = post("/api/state", wrong);
  EXPECT_EQ(answer.status, 400);
  EXPECT_EQ(Json::parse(answer.body)["key"], "cell.radius_um");
  wrong = cell();
  wrong["flow"].erase("viscosity_mPas");
  EXPECT_EQ(json("/api/state", wrong)["key"], "flow.viscosity_mPas");
  wrong["flow"]["viscosity_mPas"] = true;
  EXPECT_EQ(json("/api/state", wrong)["key"], "flow.viscosity_mPas");
  EXPECT_EQ(routes_.router().answer({.method = "POST", .path = "/api/state", .body = "[1,"}).status, 400);
  Json in_time = cell();
  in_time["time"]["end_us"] = 100;
  in_time["cell"]["viscosity_mPas"] = 15;
  EXPECT_EQ(json("/api/state", in_time)["reason"], "time");
}

TEST_F(CellRoutes, NamesMayBeDottedAndNullIsNotGiven) {
  const Json dotted{{"channel.width_um", 20},    {"channel.radius_um", nullptr}, {"flow.rate_ul_per_s", 0.04},
                    {"flow.viscosity_mPas", 15}, {"cell.radius_um", 7},          {"cell.bulk.young_modulus_kPa", 4},
                    {"numerics.accuracy", 1e-3}};
  EXPECT_EQ(json("/api/case/text", dotted)["toml"], json("/api/case/text", cell())["toml"]);
}

TEST_F(CellRoutes, ACaseAsTextReadsBackToItself) {
  const Json text = json("/api/case/text", cell());
  const Json back = json("/api/case/read", {{"toml", text["toml"]}})["case"];
  EXPECT_EQ(json("/api/case/text", back)["toml"], text["toml"]);
  EXPECT_EQ(post("/api/case/read", {{"toml", "[cell]\nradius_um = 1e9"}}).status, 400);
}

TEST_F(CellRoutes, AWayInTimeComesLineByLine) {
  Json in_time = cell(8);
  in_time["time"] = {{"end_us", 40}, {"output_every_us", 10}, {"degree", 4}, {"accuracy", 1e-4}};
  in_time["cell"]["viscosity_mPas"] = 15;
  const std::vector<Json> steps = lines_of(post("/api/evolve", in_time, {{"fields", "1"}}));
  ASSERT_EQ(steps.size(), 6u);
  for (int i = 0; i < 5; ++i) {
    EXPECT_NEAR(steps[i]["time_s"].get<double>(), i * 1e-5, 1e-12);
    EXPECT_TRUE(steps[i]["velocity_m_per_s"].is_number()) << i;
    const Json& fields = steps[i]["fields"];
    const auto points = fields["points"].get<std::size_t>();
    EXPECT_GT(points, 500u);
    EXPECT_EQ(fields["region"].get<std::string>().size(), 4 * ((points + 2) / 3)) << "base64 of a byte each";
    EXPECT_TRUE(fields["values"].contains("stress_Pa"));
  }
  EXPECT_LT(steps[0]["deformation"].get<double>(), 1e-6);
  EXPECT_EQ(steps[4]["progress"], 1);
  EXPECT_EQ(steps[4]["deformation"], steps[5]["result"]["deformation"]);
  EXPECT_EQ(steps[5]["result"]["time"]["frames"], 5);
  EXPECT_EQ(post("/api/evolve", cell()).status, 400);
}

TEST_F(CellRoutes, ExportsGoIntoTheFolderAndOverNothingForeign) {
  const Json wish{{"what", "case"}, {"case", cell()}, {"name", "mine.toml"}};
  const fs::path file = json("/api/export", wish)["file"].get<std::string>();
  EXPECT_EQ(file, folder_ / "mine.toml");
  EXPECT_FALSE(ViewSession::is_session(file));
  EXPECT_EQ(post("/api/export", wish).status, 200);  // its own file
  std::ofstream(folder_ / "foreign.toml") << "kept";
  Json other = wish;
  other["name"] = "foreign.toml";
  EXPECT_EQ(post("/api/export", other).status, 409);
  for (const char* name : {"", ".", "..", "../up.toml", "/abs.toml", "a/b.toml", ".hidden"}) {
    other["name"] = name;
    EXPECT_EQ(post("/api/export", other).status, 400) << name;
  }
  EXPECT_EQ(post("/api/export", {{"what", "nothing"}}).status, 400);
}

TEST_F(CellRoutes, AnExportDoesNotReplaceWhatOthersHaveWrittenMeanwhile) {
  Json wish{{"what", "case"}, {"case", cell()}, {"name", "mine.toml"}};
  ASSERT_EQ(post("/api/export", wish).status, 200);
  std::ofstream(folder_ / "mine.toml") << "edited by hand";
  EXPECT_EQ(post("/api/export", wish).status, 409);
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_), {}), 1) << "nothing hidden is left";
  const Json result{{"what", "result"}, {"case", cell()}, {"name", "both"}};
  ASSERT_EQ(post("/api/export", result).status, 200);
  wish["name"] = "both";
  EXPECT_EQ(post("/api/export", wish).status, 409) << "a folder stands there";
  EXPECT_EQ(post("/api/export", result).status, 200) << "its own";
  fs::remove_all(folder_ / "both");
  fs::create_directory(folder_ / "both");
  EXPECT_EQ(post("/api/export", result).status, 409) << "somebody else's";
}

TEST_F(CellRoutes, AnExportEndsWhenItsClientHasLeft) {
  class Left final : public Client {
    bool has_left() const override { return true; }
  } const left;
  const Json wish{{"what", "result"}, {"case", cell()}, {"name", "in vain"}};
  const Answer answer =
      routes_.router().answer({.method = "POST", .path = "/api/export", .body = wish.dump(), .client = &left});
  EXPECT_EQ(answer.status, 503) << answer.body;
  EXPECT_TRUE(fs::is_empty(folder_));
}

TEST_F(CellRoutes, AnExportedResultHasTheFilesAndDigitsOfSolve) {
  const fs::path result =
      json("/api/export", {{"what", "result"}, {"case", cell()}, {"name", "cell"}})["file"].get<std::string>();
  for (const char* file : {"case.toml", "contour.csv", "fields.vtu", "result.json"})
    EXPECT_TRUE(fs::exists(result / file)) << file;
  const Case c = case_from_json(cell());
  const Json written = Json::parse(std::ifstream(result / "result.json"));
  const StationaryState state = solve_stationary(problem_of(c));
  EXPECT_EQ(written["deformation"].get<double>(), state.shape.deformation);
}

TEST_F(CellRoutes, PicturesAreWrittenByteByByte) {
  const std::string bytes("\x89PNG\0\xFF", 6);
  const Json wish{{"what", "png"}, {"name", "a.png"}, {"data", base64_of(bytes.data(), bytes.size())}};
  std::ifstream stream(json("/api/export", wish)["file"].get<std::string>(), std::ios::binary);
  EXPECT_EQ(std::string(std::istreambuf_iterator<char>(stream), {}), bytes);
  EXPECT_EQ(post("/api/export", {{"what", "png"}, {"name", "a.svg"}, {"data", "AAAA"}}).status, 400);
  EXPECT_EQ(post("/api/export", {{"what", "png"}, {"name", "b.png"}, {"data", "A*=="}}).status, 400);
}

TEST_F(CellRoutes, ASessionReadsBackWhateverStandsInIt) {
  const Json page{{"tricky", "it's '''quoted''' \\ \"twice\" \n\u00b5 [[[{{{ \u4f60"}, {"list", {1, nullptr, 2.5}}};
  EXPECT_EQ(post("/api/session", {{"page", page}}, {}, "PUT").status, 200);
  const fs::path file = json("/api/export", {{"what", "session"}, {"name", "session.toml"}})["file"].get<std::string>();
  EXPECT_EQ(post("/api/session", {{"page", {{"other", 1}}}}, {}, "PUT").status, 200);
  EXPECT_TRUE(ViewSession::is_session(file));
  routes_.open(file);
  EXPECT_EQ(Json::parse(post("/api/session", {}, {}, "GET").body)["page"], page);
  EXPECT_EQ(post("/api/session", Json::object(), {}, "PUT").status, 400);
}

TEST(Base64, ItGivesBackTheBytesAndRefusesTheRest) {
  for (std::size_t size = 0; size < 10; ++size) {
    const std::string bytes(size, '\xE7');
    std::string back;
    EXPECT_TRUE(decode_base64(base64_of(bytes.data(), size), back));
    EXPECT_EQ(back, bytes);
  }
  std::string bytes;
  for (const char* text : {"A", "AA", "AAA", "A===", "====", "AA=A", "AAA*"})
    EXPECT_FALSE(decode_base64(text, bytes)) << text;
}

}  // namespace
}  // namespace rheocyte::cell_routes_test

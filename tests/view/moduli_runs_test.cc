// Moduli of recordings by requests: those of the command with the same settings and gates, for the files as they are
// now.
#include <algorithm>

#include "infer/modulus_state.h"
#include "recording_requests.h"
#include "report/recommended_columns.h"

namespace rheocyte::recording_requests {
namespace {

class ModuliOfRecordings : public RecordingRequests {};

TEST_F(ModuliOfRecordings, AreThoseOfExtractAsFeatures) {
  open_virtual_cells(50);
  EXPECT_EQ(json("GET", "/api/items/0/moduli")["state"], "none");
  EXPECT_EQ(ask("GET", "/api/items/0/events", {{"features", "emodulus"}}).status, 400);
  const Json state = moduli({{"temperature", 23}});
  ASSERT_EQ(state["state"], "ready") << state;
  EXPECT_NE(state["command"].get<std::string>().find("--temperature 23"), std::string::npos);
  ExtractOptions options;
  options.measuring.temperature = "23";
  const auto summary = extract(folder_ / "cells.rtdc", {folder_ / "want.rtdc", folder_ / "want.tsv"}, options);
  EXPECT_EQ(state["summary"]["valid"], summary.counts[0]);
  EXPECT_EQ(state["lines"][0], in_one_line(summary));
  const Json item = json("GET", "/api/items/0");
  for (const char* name :
       {"emodulus", "state", "young_modulus_kPa_error", "young_modulus_asymmetry_kPa", "shape_excess"})
    EXPECT_NE(std::ranges::find(item["features"], name), item["features"].end()) << name;
  const auto numbers = numbers_in<double>(
      bytes_of(ask("GET", "/api/items/0/events", {{"features", "emodulus,state"}, {"type", "float64"}})));
  const auto half = numbers.begin() + static_cast<std::ptrdiff_t>(numbers.size() / 2);
  expect_same({numbers.begin(), half}, column(folder_ / "want.rtdc", "emodulus"));
  const Recording want(folder_ / "want.rtdc");
  const std::string state_feature = want.metadata().text("user:rheocyte state").value();
  expect_same({half, numbers.end()}, column(folder_ / "want.rtdc", state_feature));
  EXPECT_EQ(json("DELETE", "/api/items/0/moduli")["state"], "none");
  EXPECT_EQ(ask("GET", "/api/items/0/events", {{"features", "emodulus"}}).status, 400);
}

/// The part of a summary's columns that is to be reported.
Json recommended_in(const Json& summary) {
  Json recommended = Json::object();
  for (const auto& [name, value] : summary.items())
    if (name.starts_with(start_of_recommended)) recommended[name.substr(std::strlen(start_of_recommended))] = value;
  return recommended;
}

TEST_F(ModuliOfRecordings, RecommendWithinGatesWhatExtractRecommendsWithTheSame) {
  open_virtual_cells(120);
  const Json gates{{"min", {"area_um=70"}}, {"max", {"area_um=110"}}, {"polygon", {"area_um,deform=60,0:120,0:60,1"}}};
  const auto asked = [&](const Json& of) { return ask("POST", "/api/items/0/report", {}, json_text(of)); };
  EXPECT_EQ(asked(gates).status, 409) << "without moduli";
  const Json all = moduli({{"viscosity_mPas", 30}});
  ASSERT_EQ(all["state"], "ready") << all;
  ExtractOptions options;
  options.measuring.viscosity_mPas = 30;
  options.measuring.gates = {{"area_um=70"}, {"area_um=110"}, {"area_um,deform=60,0:120,0:60,1"}};
  const auto summary = extract(folder_ / "cells.rtdc", {folder_ / "want.rtdc", folder_ / "want.tsv"}, options);
  const Json found = parse_sound_json(asked(gates).body);
  EXPECT_EQ(recommended_in(found["summary"]), recommended_json(summary)) << "number and sentence";
  EXPECT_EQ(found["summary"]["gated"], summary.counts[std::size_t(ModulusState::gated)]);
  EXPECT_EQ(found["lines"][0], in_one_line(summary));
  EXPECT_TRUE(found["summary"]["recommended_young_modulus_median_kPa"].is_number());
  EXPECT_NE(recommended_in(found["summary"]), recommended_in(all["summary"]));
  EXPECT_EQ(json("GET", "/api/items/0/moduli"), all) << "the moduli stay those of all events";

  std::vector<std::size_t> within;
  const auto states =
      column(folder_ / "want.rtdc", Recording(folder_ / "want.rtdc").metadata().text("user:rheocyte state").value());
  for (std::size_t event = 0; event < states.size(); ++event)
    if (states[event] != double(ModulusState::gated)) within.push_back(event);
  // Gates for which the command has no option go by the numbers of their events. Which of them are on the shape is
  // unknown then: that part of the error, which is stated in the text, is not there.
  Json by_numbers = recommended_in(parse_sound_json(asked({{"gate", within}}).body)["summary"]);
  Json by_settings = recommended_json(summary);
  EXPECT_LE(by_numbers["young_modulus_median_kPa_common_error"], by_settings["young_modulus_median_kPa_common_error"]);
  for (Json* const recommended : {&by_numbers, &by_settings})
    for (const char* const name : {"text", "young_modulus_median_kPa_common_error"}) recommended->erase(name);
  EXPECT_EQ(by_numbers, by_settings);
  EXPECT_EQ(asked({{"min", {"nonsense=1"}}}).status, 400);
  EXPECT_EQ(asked({{"polygon", {"/etc/passwd.poly"}}}).status, 400);
}

TEST_F(ModuliOfRecordings, TellWhatIsWrong) {
  open("a.rtdc", [](RecordingWriter& writer) { writer.scalar("area_um", {80, 90}); });
  const Json state = moduli(Json::object());
  EXPECT_EQ(state["state"], "failed");
  EXPECT_NE(state["error"].get<std::string>().find("has neither deform"), std::string::npos) << state;
  EXPECT_EQ(ask("POST", "/api/items/0/moduli", {}, R"({"table": "/etc/passwd"})").status, 400);
}

TEST_F(ModuliOfRecordings, StopWhenTheyAreAskedTo) {
  open_virtual_cells(400);
  ASSERT_EQ(ask("POST", "/api/items/0/moduli", {}, "{}").status, 202);
  EXPECT_EQ(json("DELETE", "/api/items/0/moduli")["state"], "none") << "and it does not wait for them";
  EXPECT_EQ(moduli(Json::object())["state"], "ready");
}

TEST_F(ModuliOfRecordings, AreToldOfAnEventAsTheyAreNow) {
  open_virtual_cells(20);
  const Json before = json("GET", "/api/items/0/events/3");
  EXPECT_EQ(json("GET", "/api/items/0/events/3"), before);
  ASSERT_EQ(moduli({{"viscosity_mPas", 30}})["state"], "ready");
  const Json after = json("GET", "/api/items/0/events/3");
  EXPECT_GT(after["young_modulus_kPa"].get<double>(), before["young_modulus_kPa"].get<double>());
  EXPECT_EQ(after["features"]["emodulus"].get<float>(), after["young_modulus_kPa"].get<float>());
  write_over("cells.rtdc", 10, 1);
  EXPECT_EQ(ask("GET", "/api/items/0/events/15").status, 400);
}

TEST_F(ModuliOfRecordings, AreThereNoLongerOnceTheRecordingHasChanged) {
  open_virtual_cells(20);
  ASSERT_EQ(moduli({{"temperature", 23}})["state"], "ready");
  EXPECT_EQ(json("GET", "/api/items/0/events/3")["features"].contains("emodulus"), true);
  write_over("cells.rtdc", 20, 31);
  const Json state = json("GET", "/api/items/0/moduli");
  EXPECT_EQ(state["state"], "failed");
  EXPECT_NE(state["error"].get<std::string>().find("has changed since"), std::string::npos) << state;
  EXPECT_FALSE(state.contains("summary"));
  EXPECT_EQ(state["settings"]["temperature"], "23") << "for lines and single events";
  EXPECT_FALSE(json("GET", "/api/items")[0].contains("counts"));
  EXPECT_EQ(ask("GET", "/api/items/0/events", {{"features", "emodulus"}}).status, 400);
  EXPECT_FALSE(json("GET", "/api/items/0/events/3")["features"].contains("emodulus"));
  ASSERT_EQ(moduli({{"temperature", 23}})["state"], "ready");
  EXPECT_EQ(ask("GET", "/api/items/0/events", {{"features", "emodulus"}}).status, 200);
}

TEST_F(ModuliOfRecordings, AreThereNoLongerOnceABasinHasChanged) {
  test::write_virtual_cells(folder_ / "cells.rtdc", 20);
  extract(folder_ / "cells.rtdc", {folder_ / "other_rheocyte.rtdc", folder_ / "other.tsv"});
  open(folder_ / "other_rheocyte.rtdc");
  ASSERT_EQ(moduli(Json::object())["state"], "ready");
  write_over("cells.rtdc", 20, 31);
  EXPECT_EQ(json("GET", "/api/items/0/moduli")["state"], "failed");
}

TEST_F(ModuliOfRecordings, KeepApartFromAStoredModulus) {
  open("a.rtdc", [](RecordingWriter& writer) {
    writer.scalar("area_um", {80, 90, 100});
    writer.scalar("deform", {0.02, 0.03, 0.04});
    writer.scalar("emodulus", {1.5, 1.25, 1});
    writer.scalar("basinmap0", {4, 5, 6});
  });
  const auto offers = [&](const char* name) {
    const Json features = json("GET", "/api/items/0")["features"];
    return std::ranges::find(features, name) != features.end();
  };
  const auto first = [&](const char* name) {
    return numbers_in<double>(
        bytes_of(ask("GET", "/api/items/0/events", {{"features", name}, {"type", "float64"}})))[0];
  };
  wait_until_described();
  EXPECT_TRUE(offers("emodulus_stored"));
  EXPECT_FALSE(offers("emodulus") || offers("basinmap0"));
  EXPECT_EQ(first("emodulus_stored"), 1.5);
  EXPECT_EQ(ask("GET", "/api/items/0/events", {{"features", "emodulus"}}).status, 400);
  ASSERT_EQ(moduli({{"temperature", 23}})["state"], "ready");
  EXPECT_TRUE(offers("emodulus"));
  EXPECT_EQ(first("emodulus_stored"), 1.5);
  EXPECT_NE(first("emodulus"), 1.5);
}

TEST_F(ModuliOfRecordings, AreComputedAgainByASession) {
  open_virtual_cells(20);
  const Json first = moduli({{"viscosity_mPas", 30}});
  ASSERT_EQ(first["state"], "ready") << first;
  const fs::path file = exported("session", "session.toml")["file"].get<std::string>();
  ASSERT_EQ(ask("DELETE", "/api/items/0/moduli").status, 200);
  routes_->open(file);
  Json again;
  do again = json("GET", "/api/items/0/moduli");
  while (again["state"] == "running");
  EXPECT_EQ(again["summary"], first["summary"]);
  EXPECT_EQ(again["command"], first["command"]);
}

}  // namespace
}  // namespace rheocyte::recording_requests

// Items and events by requests: what recordings hold comes back number for number.
#include <algorithm>
#include <cmath>
#include <sstream>

#include "infer/modulus_state.h"
#include "recording_requests.h"
#include "store/file_version.h"

namespace rheocyte::recording_requests {
namespace {

class RecordingRoutes : public RecordingRequests {};

TEST_F(RecordingRoutes, EachStateOfAModulusIsNamedAndAllButAValidOneAreExplained) {
  open_virtual_cells(1);
  const Json states = json("GET", "/api/states");
  ASSERT_EQ(states.size(), names_of_modulus_states.size());
  for (std::size_t k = 0; k < states.size(); ++k) {
    const ModulusState state{int(k)};
    EXPECT_EQ(states[k]["number"], k);
    EXPECT_EQ(states[k]["name"], name_of(state));
    EXPECT_EQ(states[k]["has_modulus"], has_modulus(state));
    EXPECT_EQ(states[k]["sentence"].get<std::string>().empty(), state == ModulusState::valid);
  }
}

TEST_F(RecordingRoutes, GiveColumnsOneAfterAnotherAsTheyAreStored) {
  open("a.rtdc", [](RecordingWriter& writer) {
    writer.scalar("area_um", {80.1, 90.2, 100.3});
    writer.scalar("circ", {0.97, NAN, 0.95});
  });
  const Answer answer = ask("GET", "/api/items/0/events", {{"features", "area_um,deform"}, {"type", "float64"}});
  ASSERT_EQ(answer.status, 200) << answer.body;
  ASSERT_EQ(answer.headers.size(), 1u);
  EXPECT_EQ(parse_sound_json(answer.headers[0].second), (Json{{"features", {"area_um", "deform"}},
                                                              {"events", 3},
                                                              {"version", file_version(folder_ / "a.rtdc")},
                                                              {"type", "float64"}}));
  const auto numbers = numbers_in<double>(bytes_of(answer));
  ASSERT_EQ(numbers.size(), 6u);
  EXPECT_EQ(numbers[1], 90.2);
  EXPECT_EQ(numbers[3], 1 - 0.97);
  EXPECT_TRUE(std::isnan(numbers[4]));
}

TEST_F(RecordingRoutes, GiveManyEventsInBlocksAndSinglePrecisionUnlessAsked) {
  std::vector<double> areas(200'001);
  for (std::size_t i = 0; i < areas.size(); ++i) areas[i] = 50 + 1e-3 * static_cast<double>(i);
  open("a.rtdc", [&](RecordingWriter& writer) {
    writer.scalar("area_um", areas);
    writer.scalar("deform", areas);
  });
  const auto numbers = numbers_in<float>(bytes_of(ask("GET", "/api/items/0/events", {{"features", "area_um"}})));
  ASSERT_EQ(numbers.size(), areas.size());
  for (const std::size_t i : {std::size_t{0}, std::size_t{65'536}, std::size_t{200'000}})
    EXPECT_EQ(numbers[i], static_cast<float>(areas[i]));
}

TEST_F(RecordingRoutes, RefuseWhatIsNotThereWithASentence) {
  open("a.rtdc", [](RecordingWriter& writer) { writer.scalar("area_um", {80, 90}); });
  const auto refusal = [&](const std::string& path, Request::Names query, int status, const std::string& words) {
    const Answer answer = ask("GET", path, std::move(query));
    EXPECT_EQ(answer.status, status) << answer.body;
    EXPECT_NE(answer.body.find(words), std::string::npos) << answer.body;
  };
  refusal("/api/items/1", {}, 404, "no item");
  refusal("/api/items/-1/events", {{"features", "area_um"}}, 404, "whole number");
  refusal("/api/items/0/events", {}, 400, "features");
  refusal("/api/items/0/events", {{"features", "area_um,nonsense"}}, 400, "has no feature nonsense");
  refusal("/api/items/0/events", {{"features", "area_um"}, {"type", "int"}}, 400, "float64");
  fs::remove(folder_ / "a.rtdc");
  refusal("/api/items/0/events", {{"features", "area_um"}}, 400, "no such file");
}

TEST_F(RecordingRoutes, GiveEventsPicturesAndLines) {
  open_virtual_cells(20);
  const Json event = json("GET", "/api/items/0/events/3");
  EXPECT_EQ(event["event"], 3);
  EXPECT_FALSE(event["outline"].is_null());
  for (const char* picture : {"image", "mask"}) {
    const Answer answer = ask("GET", std::string("/api/items/0/events/3/") + picture);
    EXPECT_EQ(answer.type, "image/png");
    EXPECT_TRUE(answer.body.starts_with("\x89PNG")) << answer.body;
  }
  EXPECT_EQ(ask("GET", "/api/items/0/events/20").status, 400);
  const Json lines = json("GET", "/api/items/0/lines");
  EXPECT_EQ(lines["lines"].size(), 11u);
  EXPECT_GT(lines["range"]["x"].size(), 100u);
  const Answer others = ask("GET", "/api/items/0/lines", {{"x", "area_um"}, {"y", "emodulus"}});
  EXPECT_TRUE(parse_sound_json(others.body)["lines"].empty());
}

TEST_F(RecordingRoutes, RefuseToExportTheGateOfARecordingThatHasChangedSince) {
  open_virtual_cells(20);
  const std::string before = file_version(folder_ / "cells.rtdc");
  const auto status = [&](const char* name) {
    const Json wish{{"what", "events"}, {"item", 0}, {"name", name}, {"gate", {3}}, {"version", before}};
    return ask("POST", "/api/export", {}, json_text(wish)).status;
  };
  EXPECT_EQ(status("before.tsv"), 200);
  write_over("cells.rtdc", 20, 31);
  EXPECT_EQ(status("after.tsv"), 409);
}

TEST_F(RecordingRoutes, ExportWhatExtractWrites) {
  open_virtual_cells(30);
  extract(folder_ / "cells.rtdc", {folder_ / "want.rtdc", folder_ / "want.tsv"});
  const Json events = exported("events", "events.tsv"), companion = exported("companion", "cells_rheocyte.rtdc");
  ASSERT_TRUE(events.contains("file")) << events;
  EXPECT_EQ(events["file"], (folder_ / "out/events.tsv").string());
  EXPECT_EQ(content_of(folder_ / "out/events.tsv"), content_of(folder_ / "want.tsv"));
  ASSERT_TRUE(companion.contains("file")) << companion;
  for (int k = -1; k < 10; ++k) {
    const std::string feature = k < 0 ? "emodulus" : "userdef" + std::to_string(k);
    if (Recording(folder_ / "want.rtdc").has_scalar(feature))
      expect_same(column(folder_ / "out/cells_rheocyte.rtdc", feature), column(folder_ / "want.rtdc", feature));
  }
}

TEST_F(RecordingRoutes, ExportTheEventsOfAGate) {
  open_virtual_cells(30);
  exported("events", "all.tsv");
  ASSERT_TRUE(exported("events", "some.tsv", {7, 3}).contains("file"));
  std::istringstream some(content_of(folder_ / "out/some.tsv"));
  std::vector<std::string> lines;
  for (std::string line; std::getline(some, line);)
    if (!line.starts_with('#')) lines.push_back(line);
  ASSERT_EQ(lines.size(), 3u);
  EXPECT_TRUE(lines[1].starts_with("4\t")) << "lines count from 1, as in every table of events";
  EXPECT_NE(content_of(folder_ / "out/all.tsv").find("\n" + lines[2] + "\n"), std::string::npos);
  ASSERT_TRUE(exported("companion", "some.rtdc", {7, 3}).contains("file"));
  const auto states = column(folder_ / "out/some.rtdc",
                             Recording(folder_ / "out/some.rtdc").metadata().text("user:rheocyte state").value());
  for (std::size_t event = 0; event < states.size(); ++event)
    EXPECT_EQ(states[event] == static_cast<double>(ModulusState::gated), event != 3 && event != 7);
}

TEST_F(RecordingRoutes, ExportNothingOutsideTheFolderAndNothingOverOthers) {
  open_virtual_cells(5);
  std::ofstream(folder_ / "out/there.tsv") << "somebody's";
  for (const auto& [name, status] : {std::pair("../x.tsv", 400), std::pair("/tmp/x.tsv", 400), std::pair("x.txt", 400),
                                     std::pair("there.tsv", 409)}) {
    const std::string body = json_text({{"what", "events"}, {"item", 0}, {"name", name}});
    EXPECT_EQ(ask("POST", "/api/export", {}, body).status, status) << name;
  }
  EXPECT_EQ(content_of(folder_ / "out/there.tsv"), "somebody's");
  EXPECT_FALSE(fs::exists(folder_ / "x.tsv"));
  const std::string body = json_text({{"what", "events"}, {"item", 0}, {"name", "x.tsv"}, {"gate", {-1}}});
  EXPECT_EQ(ask("POST", "/api/export", {}, body).status, 400);
}

}  // namespace
}  // namespace rheocyte::recording_requests

// Items and events by requests: what recordings hold comes back number for number.
#include "view/recording_routes.h"

#include <gtest/gtest.h>

#include <array>
#include <chrono>
#include <cmath>
#include <cstring>
#include <fstream>
#include <iterator>
#include <optional>
#include <sstream>
#include <thread>

#include "case/json_guard.h"
#include "infer/modulus_state.h"
#include "measurement/recording_writer.h"
#include "report/extract_recording.h"
#include "store/file_version.h"
#include "view/view_items.h"
#include "virtual_cells.h"

namespace rheocyte::recording_routes_test {
namespace {

namespace fs = std::filesystem;
using test::RecordingWriter;
using Json = nlohmann::ordered_json;

/// A server's insides without a server.
class RecordingRoutes : public testing::Test {
 protected:
  void open(const std::string& name, const std::function<void(RecordingWriter&)>& fill) {
    {
      RecordingWriter writer(folder_ / name);
      test::write_usual_metadata(writer);
      fill(writer);
    }
    open(folder_ / name);
  }
  void open_virtual_cells(int cells) {
    test::write_virtual_cells(folder_ / "cells.rtdc", cells);
    open(folder_ / "cells.rtdc");
  }
  /// Other cells in the place of those of a file, which is written into.
  void write_over(const std::string& name, int cells, int seed) {
    test::write_virtual_cells(folder_ / "others.rtdc", cells, seed);
    fs::rename(folder_ / "others.rtdc", folder_ / name);  // one that is open in this process cannot be written anew
  }
  void wait_until_described() const {
    for (int round = 0; round < 3000 && json("GET", "/api/items")[0]["state"] == "loading"; ++round)
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  void open(const fs::path& file) {
    const std::array<fs::path, 1> paths{file};
    items_.emplace(paths);
    add_recording_routes(router_, exports_, session_, *items_);
    exports_.add_route(router_);
  }

  Answer ask(const std::string& method, const std::string& path, Request::Names query = {},
             const std::string& body = {}) const {
    Request request;
    request.method = method;
    request.path = path;
    request.query = std::move(query);
    request.body = body;
    return router_.answer(request);
  }
  static std::string bytes_of(const Answer& answer) {
    std::string bytes;
    answer.give_pieces([&](std::string_view piece) {
      bytes += piece;
      return true;
    });
    return bytes;
  }

  Json json(const std::string& method, const std::string& path, const std::string& body = {}) const {
    return parse_sound_json(ask(method, path, {}, body).body);
  }
  /// Once it no longer runs.
  Json moduli(const Json& settings) const {
    const Answer started = ask("POST", "/api/items/0/moduli", {}, json_text(settings));
    EXPECT_EQ(started.status, 202) << started.body;
    Json state;
    for (int round = 0; round < 3000; ++round) {
      state = json("GET", "/api/items/0/moduli");
      if (state["state"] != "running") break;
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
    return state;
  }
  Json exported(const std::string& what, const std::string& name, const Json& gate = nullptr) const {
    return json("POST", "/api/export", json_text({{"what", what}, {"item", 0}, {"name", name}, {"gate", gate}}));
  }

  test::ScratchFolder folder_;
  ExportFolder out_{folder_ / "out"};
  Exports exports_{out_};
  ViewSession session_;
  std::optional<ViewItems> items_;
  Router router_;
};

template <class Number>
std::vector<Number> numbers_in(const std::string& bytes) {
  std::vector<Number> numbers(bytes.size() / sizeof(Number));
  std::memcpy(numbers.data(), bytes.data(), numbers.size() * sizeof(Number));
  return numbers;
}

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

std::string content_of(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

std::vector<double> column(const fs::path& file, const std::string& feature) {
  const Recording recording(file);
  std::vector<double> values(recording.events());
  recording.read_scalar(feature, 0, values);
  return values;
}

void expect_same(const std::vector<double>& a, const std::vector<double>& b) {
  ASSERT_EQ(a.size(), b.size());
  EXPECT_EQ(std::memcmp(a.data(), b.data(), a.size() * sizeof(double)), 0) << "to the last bit, NaN included";
}

/// What `rheocyte extract` writes.
ExtractSummary extract(const fs::path& file, const ExtractOutput& output, const ExtractOptions& options = {}) {
  ExtractFiles files(output, true);
  const auto summary = extract_recording(file, files, options, ModulusTables(options.table), [](double) {});
  files.publish();
  return summary;
}

TEST_F(RecordingRoutes, GiveTheModuliOfExtractAsFeatures) {
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

TEST_F(RecordingRoutes, TellWhatIsWrongWithModuli) {
  open("a.rtdc", [](RecordingWriter& writer) { writer.scalar("area_um", {80, 90}); });
  const Json state = moduli(Json::object());
  EXPECT_EQ(state["state"], "failed");
  EXPECT_NE(state["error"].get<std::string>().find("has neither deform"), std::string::npos) << state;
  EXPECT_EQ(ask("POST", "/api/items/0/moduli", {}, R"({"table": "/etc/passwd"})").status, 400);
}

TEST_F(RecordingRoutes, StopModuliWhenTheyAreAskedTo) {
  open_virtual_cells(400);
  ASSERT_EQ(ask("POST", "/api/items/0/moduli", {}, "{}").status, 202);
  EXPECT_EQ(json("DELETE", "/api/items/0/moduli")["state"], "none") << "and it does not wait for them";
  EXPECT_EQ(moduli(Json::object())["state"], "ready");
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

TEST_F(RecordingRoutes, TellAnEventFromTheFileAndTheModuliAsTheyAreNow) {
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

TEST_F(RecordingRoutes, HaveNoModuliOfARecordingThatHasChanged) {
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

TEST_F(RecordingRoutes, HaveNoModuliOnceABasinHasChanged) {
  test::write_virtual_cells(folder_ / "cells.rtdc", 20);
  extract(folder_ / "cells.rtdc", {folder_ / "other_rheocyte.rtdc", folder_ / "other.tsv"});
  open(folder_ / "other_rheocyte.rtdc");
  ASSERT_EQ(moduli(Json::object())["state"], "ready");
  write_over("cells.rtdc", 20, 31);
  EXPECT_EQ(json("GET", "/api/items/0/moduli")["state"], "failed");
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

TEST_F(RecordingRoutes, KeepAStoredModulusApartFromTheComputedOneAndOfferNoNumbersOfBasins) {
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

TEST_F(RecordingRoutes, ASessionComputesItsModuliAgain) {
  open_virtual_cells(20);
  const Json first = moduli({{"viscosity_mPas", 30}});
  ASSERT_EQ(first["state"], "ready") << first;
  const fs::path file = folder_ / "session.toml";
  std::ofstream(file) << session_.text();
  ASSERT_EQ(ask("DELETE", "/api/items/0/moduli").status, 200);
  session_.read(file);
  Json again;
  do again = json("GET", "/api/items/0/moduli");
  while (again["state"] == "running");
  EXPECT_EQ(again["summary"], first["summary"]);
  EXPECT_EQ(again["command"], first["command"]);
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
}  // namespace rheocyte::recording_routes_test

// The list of items: what is named, found and missing; what is wrong with one harms no other.
#include "view/view_items.h"

#include <gtest/gtest.h>

#include <array>
#include <chrono>
#include <fstream>
#include <thread>

#include "measurement/recording_writer.h"
#include "serve/http.h"
#include "store/thread.h"

namespace rheocyte::view_items_test {
namespace {

namespace fs = std::filesystem;
using test::RecordingWriter;
using Json = nlohmann::ordered_json;

class Items : public testing::Test {
 protected:
  void write_recording(const std::string& name, const std::vector<double>& areas = {80, 90, 100}) const {
    fs::create_directories((folder_ / name).parent_path());
    RecordingWriter writer(folder_ / name);
    test::write_usual_metadata(writer);
    writer.scalar("area_um", areas);
    writer.scalar("deform", std::vector<double>(areas.size(), 0.03));
  }
  void write(const std::string& name, const std::string& text) const {
    fs::create_directories((folder_ / name).parent_path());
    std::ofstream(folder_ / name) << text;
  }

  test::ScratchFolder folder_;
};

/// Waits until nothing is loading.
Json loaded(ViewItems& items) {
  for (int round = 0; round < 1000; ++round) {
    Json list = items.list();
    if (std::ranges::none_of(list, [](const Json& item) { return item["state"] == "loading"; })) return list;
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  ADD_FAILURE() << "items are still loading";
  return {};
}

TEST_F(Items, AreFoundInFoldersWithoutCompanionsOfRecordingsThatAreThere) {
  write_recording("data/a.rtdc");
  write_recording("data/a_rheocyte.rtdc");
  write_recording("data/day 2/a.rtdc");
  write_recording("data/alone_rheocyte.rtdc");
  write("data/table/combined_XC-2D-26.csv", "");
  write("data/result/result.json", R"({"case": {"cell": {"radius_um": 7}}})");
  const std::array<fs::path, 2> paths{folder_ / "data", folder_ / "data/a.rtdc"};
  const auto places = item_places(paths);
  ASSERT_EQ(places.size(), 5u);
  EXPECT_EQ(places[0].name, "a.rtdc");
  EXPECT_EQ(places[1].name, "alone_rheocyte.rtdc");
  EXPECT_EQ(places[2].name, "day 2/a.rtdc");
  EXPECT_EQ(places[3].name, "result");
  EXPECT_EQ(places[3].kind, ItemKind::result);
  EXPECT_EQ(places[4].kind, ItemKind::combined);
}

TEST_F(Items, ThatAreDamagedOrMissingStayInTheListWithASentence) {
  write_recording("good.rtdc");
  write("damaged.rtdc", "no recording");
  write("case.toml", "[cell]\nradius_um = -1\n");
  const std::array<fs::path, 4> paths{folder_ / "damaged.rtdc", folder_ / "good.rtdc", folder_ / "case.toml",
                                      folder_ / "none.rtdc"};
  ViewItems items(paths);
  const Json list = loaded(items);
  ASSERT_EQ(list.size(), 4u);
  EXPECT_EQ(list[0]["state"], "failed");
  EXPECT_NE(list[0]["error"].get<std::string>().find("is not an HDF5 file"), std::string::npos) << list[0];
  EXPECT_EQ(list[1]["state"], "ready");
  EXPECT_EQ(list[1]["events"], 3);
  EXPECT_EQ(list[1]["conditions"]["medium"], "CellCarrier");
  EXPECT_EQ(list[2]["kind"], "case");
  EXPECT_NE(list[2]["error"].get<std::string>().find("radius_um"), std::string::npos) << list[2];
  EXPECT_NE(list[3]["error"].get<std::string>().find("no such file"), std::string::npos) << list[3];
}

TEST_F(Items, ThatVanishAndComeBackAreNoticed) {
  write_recording("a.rtdc");
  const std::array<fs::path, 1> paths{folder_ / "a.rtdc"};
  ViewItems items(paths);
  EXPECT_EQ(loaded(items)[0]["state"], "ready");
  fs::rename(folder_ / "a.rtdc", folder_ / "b.rtdc");
  EXPECT_NE(items.list()[0]["error"].get<std::string>().find("no longer there"), std::string::npos);
  fs::rename(folder_ / "b.rtdc", folder_ / "a.rtdc");
  EXPECT_EQ(loaded(items)[0]["state"], "ready");
}

TEST_F(Items, ThatChangeAreReadAgain) {
  write_recording("a.rtdc");
  const std::array<fs::path, 1> paths{folder_ / "a.rtdc"};
  ViewItems items(paths);
  const Json before = loaded(items);
  EXPECT_EQ(before[0]["events"], 3);
  EXPECT_EQ(items.list(), before) << "while nothing changes, nothing is read";
  write_recording("b.rtdc", {80, 90});
  fs::copy_file(folder_ / "b.rtdc", folder_ / "a.rtdc", fs::copy_options::overwrite_existing);
  EXPECT_EQ(items.list()[0]["state"], has_threads ? "loading" : "ready");
  const Json after = loaded(items);
  EXPECT_EQ(after[0]["events"], 2);
  EXPECT_NE(after[0]["version"], before[0]["version"]);
  write("a.rtdc", "no recording");
  static_cast<void>(items.list());
  EXPECT_EQ(loaded(items)[0]["state"], "failed");
  fs::copy_file(folder_ / "b.rtdc", folder_ / "a.rtdc", fs::copy_options::overwrite_existing);
  static_cast<void>(items.list());
  EXPECT_EQ(loaded(items)[0]["events"], 2);
}

TEST_F(Items, KeepLabelsAndPathsInASession) {
  write_recording("a.rtdc");
  write_recording("b.rtdc");
  const std::array<fs::path, 1> first{folder_ / "a.rtdc"};
  Json kept;
  {
    ViewItems items(first);
    items.label(0, {{"condition", "treated"}, {"replicate", "2"}});
    items.label(0, {{"replicate", "3"}});
    EXPECT_THROW(items.label(0, {{"condition", 7}}), Refused);
    EXPECT_THROW(items.label(1, Json::object()), Refused);
    kept = items.kept();
  }
  const std::array<fs::path, 1> second{folder_ / "b.rtdc"};
  ViewItems items(second);
  items.restore(kept);
  const Json list = loaded(items);
  ASSERT_EQ(list.size(), 2u);
  EXPECT_EQ(list[1]["condition"], "treated");
  EXPECT_EQ(list[1]["replicate"], "3");
}

TEST_F(Items, MayHaveNamesThatAreNotUtf8) {
  const std::string name = "zellen \xE4\xF6.rtdc";
  write_recording("plain.rtdc");
  std::error_code error;
  fs::rename(folder_ / "plain.rtdc", folder_ / name, error);
  if (error) GTEST_SKIP() << "this file system takes names of UTF-8 alone";
  const std::array<fs::path, 1> paths{folder_ / name};
  ViewItems items(paths);
  EXPECT_EQ(loaded(items)[0]["state"], "ready");
  ViewItems again({});
  again.restore(Json::parse(items.kept().dump()));
  const Json list = loaded(again);
  EXPECT_EQ(list[0]["state"], "ready") << list;
}

TEST_F(Items, OfASessionAreNotSearchedFor) {
  // A session of somebody else may name any folder, be it that of the whole disk.
  write_recording("data/a.rtdc");
  write("data/result/result.json", R"({"case": {"cell": {"radius_um": 7}}})");
  ViewItems items({});
  items.restore({{{"path", (folder_ / "data").string()}}, {{"path", (folder_ / "data/result").string()}}});
  const Json list = loaded(items);
  ASSERT_EQ(list.size(), 2u);
  EXPECT_EQ(list[0]["state"], "failed");
  EXPECT_EQ(list[1]["kind"], "result");
}

TEST_F(Items, LeaveNoTemporaryFolderBehind) {
  fs::path folder;
  {
    ViewItems items({});
    folder = items.host().folder();
    EXPECT_TRUE(fs::is_directory(folder));
  }
  EXPECT_FALSE(fs::exists(folder));
}

}  // namespace
}  // namespace rheocyte::view_items_test

// Without threads and processes what is asked is done when it is answered.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "measurement/recording_writer.h"
#include "store/thread.h"
#include "store/work_host.h"
#include "view/view_routes.h"
#include "virtual_cells.h"

namespace rheocyte::in_place_test {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

class InPlace : public testing::Test {
 protected:
  Answer ask(const std::string& method, const std::string& path, const std::string& body = {},
             const Client* client = nullptr) {
    return routes_.router().answer({.method = method, .path = path, .body = body, .client = client});
  }
  Json json(const std::string& method, const std::string& path, const std::string& body = {}) {
    return Json::parse(ask(method, path, body).body);
  }
  void open_cells(int cells) {
    test::write_virtual_cells(folder_ / "cells.rtdc", cells);
    routes_.open(folder_ / "cells.rtdc");
  }

  test::ScratchFolder folder_;
  ViewRoutes routes_{std::span<const fs::path>(), folder_ / "out"};
};

struct Left final : Client {
  bool has_left() const override { return true; }
};

TEST_F(InPlace, ThereAreNoThreads) { EXPECT_FALSE(has_threads); }

TEST_F(InPlace, ARecordingIsDescribedAsSoonAsItIsOpenAndItsModuliWhenTheyAreAskedFor) {
  open_cells(40);
  const Json items = json("GET", "/api/items");
  ASSERT_EQ(items.size(), 1u);
  EXPECT_EQ(items[0]["state"], "ready");
  EXPECT_EQ(items[0]["events"], 40);
  EXPECT_EQ(json("POST", "/api/items/0/moduli", "{}")["state"], "ready");
  EXPECT_TRUE(json("GET", "/api/items/0/events/7")["young_modulus_kPa"].is_number());
  EXPECT_TRUE(json("GET", "/api/items/0/events/8")["outline"].is_object());
}

TEST_F(InPlace, WhatIsNoRecordingIsToldAndHarmsNothingElse) {
  std::ofstream(folder_ / "no.rtdc") << "no HDF5";
  routes_.open(folder_ / "no.rtdc");
  open_cells(20);
  const Json items = json("GET", "/api/items");
  EXPECT_EQ(items[0]["state"], "failed");
  EXPECT_EQ(items[1]["state"], "ready");
}

/// Counts how often it is made.
struct Made {
  explicit Made(int* times) { ++*times; }
};

TEST_F(InPlace, WorkThatStaysFindsWhatItHasMadeWithTheNextQuestion) {
  int times = 0;
  const WorkHost host([&](const std::string&, const WorkReply& reply) {
    reply.kept<Made>(&times);
    while (const auto question = reply.next_request()) reply.give("answer to " + *question);
  });
  HostedWork work = host.ask("begin");
  for (const char* question : {"a", "b"}) {
    work.ask(question);
    EXPECT_EQ(work.all(), std::string("answer to ") + question);
  }
  EXPECT_EQ(times, 1);
}

TEST_F(InPlace, ModuliForNobodyAreStopped) {
  open_cells(40);
  const Left left;
  ask("POST", "/api/items/0/moduli", "{}", &left);
  const Json state = json("GET", "/api/items/0/moduli");
  EXPECT_EQ(state["state"], "failed");
  EXPECT_EQ(state["error"], "The request was cancelled.");
}

TEST_F(InPlace, AStateForNobodyIsStoppedBetweenTasksAndTheNextOneIsFound) {
  /// Leaves while it is solved, not before.
  struct Leaving final : Client {
    bool has_left() const override { return ++asked > 1; }
    mutable int asked = 0;
  };
  const std::string cell = R"({"channel": {"width_um": 20}, "flow": {"rate_ul_per_s": 0.04, "viscosity_mPas": 15},
    "cell": {"radius_um": 6, "bulk": {"law": "neo-hookean", "young_modulus_kPa": 4}}, "numerics": {"accuracy": 0.1}})";
  const Leaving page;
  const Answer stopped = ask("POST", "/api/state", cell, &page);
  EXPECT_EQ(stopped.status, 503);
  EXPECT_EQ(Json::parse(stopped.body)["reason"], "left");
  EXPECT_EQ(ask("POST", "/api/state", cell).status, 200);
}

/// Asks how far the moduli of an item have come whenever it is asked whether it waits, and leaves after some answers.
class Watching final : public Client {
 public:
  Watching(const Router& router, std::string path, std::size_t patience)
      : router_(router), path_(std::move(path)), patience_(patience) {}
  bool has_left() const override {
    if (told_.size() >= patience_) return true;
    const Json state = Json::parse(router_.answer({.method = "GET", .path = path_}).body);
    if (state["state"] == "running") told_.push_back(state["done"]);
    return false;
  }
  const std::vector<double>& told() const { return told_; }

 private:
  const Router& router_;
  std::string path_;
  std::size_t patience_;
  mutable std::vector<double> told_;
};

TEST_F(InPlace, HowFarModuliHaveComeIsAnsweredWhileTheyAreComputed) {
  open_cells(40);
  const Watching page(routes_.router(), "/api/items/0/moduli", 1000000);
  ask("POST", "/api/items/0/moduli", "{}", &page);
  ASSERT_FALSE(page.told().empty());
  EXPECT_TRUE(std::ranges::is_sorted(page.told()));
  EXPECT_GT(page.told().back(), 0.5);
  EXPECT_EQ(json("GET", "/api/items/0/moduli")["state"], "ready");
}

TEST_F(InPlace, ModuliThatAreStoppedHalfwayTakeNoOthersWithThem) {
  open_cells(40);
  test::write_virtual_cells(folder_ / "others.rtdc", 40);
  routes_.open(folder_ / "others.rtdc");
  ask("POST", "/api/items/0/moduli", "{}");
  const Watching page(routes_.router(), "/api/items/1/moduli", 1);
  ask("POST", "/api/items/1/moduli", "{}", &page);
  EXPECT_EQ(json("GET", "/api/items/1/moduli")["state"], "failed");
  EXPECT_EQ(json("DELETE", "/api/items/1/moduli")["state"], "none");
  EXPECT_EQ(json("GET", "/api/items/0/moduli")["state"], "ready");
  EXPECT_EQ(json("POST", "/api/items/1/moduli", "{}")["state"], "ready");
}

TEST_F(InPlace, FramesInTimeAreGivenWhileTheyAreComputed) {
  const Answer answer = ask("POST", "/api/evolve", R"({"channel": {"width_um": 20}, "flow": {"rate_ul_per_s": 0.04,
    "viscosity_mPas": 15}, "cell": {"radius_um": 6, "viscosity_mPas": 5, "bulk": {"law": "neo-hookean",
    "young_modulus_kPa": 4}}, "numerics": {"accuracy": 0.1}, "time": {"end_us": 300, "output_every_us": 20}})");
  ASSERT_TRUE(answer.give_pieces) << answer.body;
  int taken = 0;
  answer.give_pieces([&](std::string_view) { return ++taken < 3; });
  EXPECT_EQ(taken, 3);  // as many as were wanted: the rest was not computed
}

}  // namespace
}  // namespace rheocyte::in_place_test

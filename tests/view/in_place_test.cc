// Without threads and processes what is asked is done when it is answered.
#include <gtest/gtest.h>

#include <array>
#include <nlohmann/json.hpp>
#include <span>

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
  EXPECT_EQ(state["error"], "Nobody waits any more for what was asked.");
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

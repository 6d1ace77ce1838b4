#include "view/solver_threads.h"

#include <gtest/gtest.h>

#include <optional>
#include <set>
#include <stdexcept>
#include <thread>

namespace rheocyte::solver_threads_test {
namespace {

constexpr std::size_t little_memory = 1 << 20;

/// Leaves when it is asked to.
class TestClient final : public Client {
 public:
  bool has_left() const override { return left; }
  std::atomic<bool> left{false};
};

const Request nobody;

void wait_for_stop(Session&, const std::atomic<bool>& stop) {
  while (!stop) std::this_thread::yield();
}

TEST(SolverThreads, ALaterJobOfAStreamReplacesTheEarlierOne) {
  SolverThreads threads(2, little_memory);
  std::optional<JobEnd> first;
  std::atomic<bool> has_begun = false;
  std::jthread earlier([&] {
    first = threads.run({"slider", nobody, [&](Session& session, const std::atomic<bool>& stop) {
                           has_begun = true;
                           wait_for_stop(session, stop);
                         }});
  });
  while (!has_begun) std::this_thread::yield();
  EXPECT_EQ(threads.run({"slider", nobody, [](Session&, const std::atomic<bool>&) {}}), JobEnd::done);
  earlier.join();
  EXPECT_EQ(first, JobEnd::superseded);
}

TEST(SolverThreads, AStreamStaysWithItsSession) {
  SolverThreads threads(3, little_memory);
  std::set<Session*> used;
  for (int i = 0; i < 20; ++i)
    threads.run({"slider", nobody, [&](Session& session, const std::atomic<bool>&) { used.insert(&session); }});
  EXPECT_EQ(used.size(), 1u);
}

TEST(SolverThreads, AClientThatLeavesEndsItsJobRunningOrWaiting) {
  SolverThreads threads(1, little_memory);
  TestClient client;
  const Request request{.method = "POST", .path = "/", .client = &client};
  std::atomic<bool> has_begun = false;
  std::optional<JobEnd> running, waiting;
  {
    std::jthread first([&] {
      running = threads.run({"a", request, [&](Session& session, const std::atomic<bool>& stop) {
                               has_begun = true;
                               wait_for_stop(session, stop);
                             }});
    });
    while (!has_begun) std::this_thread::yield();
    std::jthread second([&] {
      waiting = threads.run({"b", request, [](Session&, const std::atomic<bool>&) { FAIL() << "it had left"; }});
    });
    while (threads.load() < 2) std::this_thread::yield();
    client.left = true;
  }
  EXPECT_EQ(running, JobEnd::left);
  EXPECT_EQ(waiting, JobEnd::left);
}

TEST(SolverThreads, WhatAJobThrowsReachesWhoWaitsForIt) {
  SolverThreads threads(1, little_memory);
  EXPECT_THROW(threads.run({"", nobody, [](Session&, const std::atomic<bool>&) { throw std::runtime_error("oops"); }}),
               std::runtime_error);
  EXPECT_EQ(threads.run({"", nobody, [](Session&, const std::atomic<bool>&) {}}), JobEnd::done);
}

TEST(SolverThreads, TheirEndStopsWhatRuns) {
  std::optional<JobEnd> end;
  std::atomic<bool> has_begun = false;
  std::jthread waiting;
  {
    SolverThreads threads(1, little_memory);
    waiting = std::jthread([&] {
      end = threads.run({"", nobody, [&](Session& session, const std::atomic<bool>& stop) {
                           has_begun = true;
                           wait_for_stop(session, stop);
                         }});
      has_begun = false;
    });
    while (!has_begun) std::this_thread::yield();
    // The threads end here, but who waits for them must have gone before their memory does.
    threads.stop();
    waiting.join();
  }
  EXPECT_EQ(end, JobEnd::left);
}

}  // namespace
}  // namespace rheocyte::solver_threads_test

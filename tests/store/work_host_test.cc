// Work in a process of its own: its answer comes whole, its failures are sentences, and its end is noticed.
#include "store/work_host.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <fstream>
#include <thread>
#include <vector>

#include "case/user_error.h"
#include "store/system_limit.h"

namespace rheocyte::work_host_test {
namespace {

namespace fs = std::filesystem;

/// Within a minute. A process that no one has asked for its status yet has ended, too: its state is Z.
bool ends(const std::string& process) {
  for (int i = 0; i < 60'000; ++i) {
    std::ifstream status("/proc/" + process + "/stat");
    std::string number, name, state = "Z";
    status >> number >> name >> state;
    if (state == "Z" || state == "X") return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return false;
}

void expect_sentence(HostedWork work, const std::string& words) {
  try {
    static_cast<void>(work.all());
    FAIL() << "wanted: " << words;
  } catch (const UserError& error) {
    EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
  }
}

TEST(WorkHost, AnswersEachOfManyThreadsWithWhatItAskedFor) {
  const WorkHost host([](const std::string& request, const WorkReply& reply) {
    reply.give(request);
    reply.report_progress(0.5);
    reply.give("!");
  });
  std::vector<std::thread> threads;
  for (char name = 'a'; name < 'i'; ++name)
    threads.emplace_back([&host, name] {
      const std::string request(300'000, name);  // several packets
      double progress = 0;
      EXPECT_EQ(host.ask(request).all({.progress = [&progress](double fraction) { progress = fraction; }}),
                request + "!");
      EXPECT_EQ(progress, 0.5);
    });
  for (auto& thread : threads) thread.join();
}

TEST(WorkHost, RemovesTheFoldersThatKilledHostsHaveLeft) {
  const fs::path left =
      new_scratch_folder(fs::temp_directory_path() / "rheocyte-view").path;  // no one holds it any more
  std::ofstream(left / "data") << "of a killed program";
  const auto echo = [](const std::string& request, const WorkReply& reply) { reply.give(request); };
  const WorkHost first(echo), second(echo);
  EXPECT_FALSE(fs::exists(left));
  EXPECT_TRUE(fs::exists(first.folder())) << "it is in use";
}

TEST(WorkHost, NobodyHoldsTheFolderForItsFiles) {
  // A program that puts files in their places claims their folder meanwhile.
  const WorkHost host([](const std::string&, const WorkReply&) {});
  EXPECT_TRUE(claim_on(host.folder()));
}

TEST(WorkHost, EndsWorkForWhichNobodyWaitsAnyMore) {
  const WorkHost host([](const std::string&, const WorkReply& reply) {
    reply.give("begun");
    while (reply.is_wanted()) ::usleep(1000);
  });
  HostedWork work = host.ask("");
  bool has_begun = false;
  const auto take = [&has_begun](std::string_view) { return has_begun = true; };
  EXPECT_THROW(work.read(take, {.stop = [&has_begun] { return has_begun; }}), UserError);
}

TEST(WorkHost, TellsWhyWorkHasFailed) {
  const WorkHost host([](const std::string& request, const WorkReply& reply) {
    if (request == "user") throw UserError("the file is red");
    if (request == "own") throw std::logic_error("a bug");
    if (request == "die") ::_exit(7);
    reply.run_isolated("cells.rtdc", [&](const TellProgress&) {
      reply.give("half of the answer");
      std::raise(SIGSEGV);
    });
  });
  expect_sentence(host.ask("user"), "the file is red");
  expect_sentence(host.ask("own"), "An error of the program");
  expect_sentence(host.ask("die"), "ended before it had answered");
  expect_sentence(host.ask("break"), "cells.rtdc: the HDF5 library broke down");
  expect_sentence(host.ask("user"), "the file is red");
}

TEST(WorkHost, ALimitOfTheSystemThatTheWorkHasMetIsOneForWhoeverAsked) {
  const WorkHost host([](const std::string& request, const WorkReply&) {
    if (request == "memory") throw std::bad_alloc();
    throw SystemLimit("processes", EAGAIN);
  });
  const auto limit_of = [&](const std::string& request) -> std::string {
    try {
      static_cast<void>(host.ask(request).all());
    } catch (const SystemLimit& limit) {
      return limit.what();
    }
    return "no limit is told";
  };
  EXPECT_EQ(limit_of("processes"), SystemLimit("processes", EAGAIN).what());
  EXPECT_EQ(limit_of("memory"), memory_does_not_suffice);
}

TEST(WorkHost, StopsIsolatedWorkForWhichNobodyWaits) {
  fs::path folder;
  std::string seen;
  {
    const WorkHost host([](const std::string&, const WorkReply& reply) {
      reply.run_isolated("cells.rtdc", [&](const TellProgress&) {
        reply.give(std::to_string(::getpid()));
        for (;;) ::pause();
      });
    });
    folder = host.folder();
    EXPECT_TRUE(fs::is_directory(folder));
    HostedWork work = host.ask("wait");
    work.read([&seen](std::string_view piece) {
      seen = piece;
      return false;
    });
  }
  EXPECT_FALSE(fs::exists("/proc/" + seen)) << "the host ends after all its work";
  EXPECT_FALSE(fs::exists(folder));
}

TEST(WorkHost, HasWorkThatStaysUntilNobodyAsksAnyMore) {
  const WorkHost host([](const std::string& request, const WorkReply& reply) {
    reply.run_isolated("cells.rtdc", [&](const TellProgress&) {
      int asked = 0;
      while (const auto next = reply.next_request()) {
        reply.give(request + *next + std::to_string(++asked) + " " + std::to_string(::getpid()));
        reply.end_answer();
      }
    });
  });
  std::string process;
  {
    HostedWork work = host.ask("a");
    for (const std::string answer : {"ab1 ", "ab2 ", "ab3 "}) {
      work.ask("b");
      const std::string text = work.all();
      EXPECT_EQ(text.substr(0, answer.size()), answer);
      process = text.substr(answer.size());
    }
  }
  EXPECT_TRUE(ends(process));
}

TEST(WorkHost, EndsAReaderFromAnotherThread) {
  const WorkHost host([](const std::string&, const WorkReply& reply) {
    reply.run_isolated("cells.rtdc", [](const TellProgress&) {
      for (;;) ::pause();
    });
  });
  std::atomic<bool> is_over = false;
  std::thread stopper([&is_over] { is_over = true; });
  EXPECT_THROW(static_cast<void>(host.ask("wait").all({.stop = [&is_over] { return is_over.load(); }})), UserError);
  stopper.join();
}

}  // namespace
}  // namespace rheocyte::work_host_test

// Whatever happens to isolated work, its parent lives on and knows what it was.
#include "store/isolated.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <stdexcept>
#include <thread>
#include <vector>

#include "case/user_error.h"
#include "store/stop_signal.h"

namespace rheocyte::isolated_test {
namespace {

using Kind = IsolatedEnd::Kind;

IsolatedEnd end_of(const std::function<std::string(const TellProgress&)>& work, const Isolation& limits = {}) {
  return run_isolated(work, limits).end;
}

TEST(Isolated, TheResultComesBackWhole) {
  const std::string text(50'000'000, 'x');  // as of the numbers of half a million events
  const auto work = [&](const TellProgress&) { return std::vector<std::string>{text, "", "more"}; };
  const auto done = run_isolated(work);
  ASSERT_TRUE(done.finished());
  EXPECT_EQ(done.result, work({}));
}

/// Some at once, of which one breaks down and one throws; each end comes once, with what belongs to it.
TEST(Isolated, SeveralAtOnceEndEachByItself) {
  std::vector<std::string> ends(8);
  std::vector<double> told(8, 0);
  IsolatedPool pool(3);
  for (std::size_t i = 0; i < ends.size(); ++i) {
    pool.start(
        [i](const TellProgress& tell) -> std::string {
          tell(0.1 * double(i));
          if (i == 2) throw UserError("a sentence.");
          if (i == 5) {
            std::signal(SIGSEGV, SIG_DFL);
            std::raise(SIGSEGV);
          }
          return std::string(100'000, char('a' + i));  // more than a pipe holds
        },
        {}, {.progress = [&told, i](double fraction) { told[i] = fraction; }},
        [&ends, i](const IsolatedEnd& end) {
          EXPECT_TRUE(ends[i].empty());
          ends[i] = end.kind == Kind::broke_down ? "broken" : end.text;
        });
  }
  pool.wait_for_all();
  for (std::size_t i = 0; i < ends.size(); ++i) {
    EXPECT_EQ(ends[i], i == 2 ? "a sentence." : i == 5 ? "broken" : std::string(100'000, char('a' + i))) << i;
    EXPECT_EQ(told[i], 0.1 * double(i));
  }
}

TEST(Isolated, ProgressIsToldInOrder) {
  std::vector<double> told;
  run_isolated(
      [](const TellProgress& tell) {
        for (int i = 0; i < 100; ++i) tell(0.01 * i);
        return std::string();
      },
      {}, {.progress = [&](double fraction) { told.push_back(fraction); }});
  ASSERT_EQ(told.size(), 100U);
  EXPECT_EQ(told.back(), 0.99);
}

TEST(Isolated, TheWatchEndsItAndWhatItThrowsComesThrough) {
  const auto hangs = [](const TellProgress& tell) -> std::string {
    for (;;) tell(0.5);
  };
  bool is_told = false;
  const Watch until_told{.progress = [&](double) { is_told = true; }, .stop = [&] { return is_told; }};
  EXPECT_TRUE(run_isolated(hangs, {}, until_told).stopped());
  EXPECT_THROW(run_isolated(hangs, {}, {.progress = [](double) { throw std::out_of_range("half"); }}),
               std::out_of_range);
}

TEST(Isolated, ErrorsComeBackAsWhatTheyAre) {
  const auto user = end_of([](const TellProgress&) -> std::string { throw UserError("a sentence."); });
  EXPECT_EQ(user.kind, Kind::user_error);
  EXPECT_EQ(user.text, "a sentence.");
  const auto own = end_of([](const TellProgress&) -> std::string { throw std::logic_error("oops"); });
  EXPECT_EQ(own.kind, Kind::own_error);
  EXPECT_EQ(own.text, "oops");
}

TEST(Isolated, ACrashIsNamed) {
  for (const int signal : {SIGSEGV, SIGABRT, SIGFPE}) {
    const auto end = end_of([&](const TellProgress&) -> std::string {
      std::signal(signal, SIG_DFL);
      std::raise(signal);
      return "not reached";
    });
    EXPECT_EQ(end.kind, Kind::broke_down) << signal;
    EXPECT_FALSE(end.text.empty());
  }
}

TEST(Isolated, AProcessThatEndsWithoutAResultHasBrokenDown) {
  EXPECT_EQ(end_of([](const TellProgress&) -> std::string { ::_exit(0); }).kind, Kind::broke_down);
}

TEST(Isolated, SignalsToTheWholeProgramDoNotBreakTheWork) {
  const auto end = end_of([](const TellProgress&) -> std::string {
    std::raise(SIGINT);
    std::raise(SIGTERM);
    return "alive";
  });
  EXPECT_EQ(end.kind, Kind::finished);
}

TEST(Isolated, AKillFromOutsideIsNoBreakdown) {
  const auto end = end_of([](const TellProgress&) -> std::string {
    std::raise(SIGKILL);
    return "not reached";
  });
  EXPECT_EQ(end.kind, Kind::killed);
}

/// The end of work that sends signals to its parent and to itself, as a terminal does, and then hangs; the exit code of
/// a process of its own.
[[noreturn]] void exit_as_stopped_by_two_signals() {
  watch_signals(SecondSignal::waits);
  const auto end = end_of([](const TellProgress&) -> std::string {
    for (const int signal : {SIGINT, SIGTERM})
      for (const pid_t process : {::getppid(), ::getpid()}) ::kill(process, signal);
    for (;;) ::pause();
  });
  std::_Exit(end.kind == Kind::stopped ? 0 : 1);
}

TEST(Isolated, TwoSignalsInARowStopTheWorkAndTheParentLivesOnToTidyUp) {
  EXPECT_EXIT(exit_as_stopped_by_two_signals(), testing::ExitedWithCode(0), "");
}

TEST(Isolated, SilenceEndsAfterItsPatience) {
  const auto end = end_of(
      [](const TellProgress&) -> std::string {
        std::this_thread::sleep_for(std::chrono::seconds(60));
        return "not reached";
      },
      {.patience_s = 0.3});
  EXPECT_EQ(end.kind, Kind::hung);
}

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)  // they need terabytes of addresses themselves
TEST(Isolated, MemoryBeyondTheLimitIsRefused) {
  const auto end = end_of(
      [](const TellProgress&) -> std::string {
        const std::string large(std::size_t{1} << 30U, 'x');
        return large.substr(0, 1);
      },
      {.memory_bytes = std::size_t{512} << 20U});
  EXPECT_EQ(end.kind, Kind::no_memory);
}
#endif

}  // namespace
}  // namespace rheocyte::isolated_test

// A thread has the same stack wherever it is started; what the system does not give is a sentence.
#include "store/thread.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <mutex>
#include <set>

#include "store/system_limit.h"

namespace rheocyte::thread_test {
namespace {

std::size_t stack_of_this_thread() {
  pthread_attr_t attributes;
  ::pthread_getattr_np(::pthread_self(), &attributes);
  void* low = nullptr;
  std::size_t size = 0;
  ::pthread_attr_getstack(&attributes, &low, &size);
  ::pthread_attr_destroy(&attributes);
  return size;
}

TEST(Threads, TheirStackDoesNotDependOnTheLimitOfTheShell) {
  rlimit before{};
  ASSERT_EQ(::getrlimit(RLIMIT_STACK, &before), 0);
  for (const rlim_t limit : {rlim_t{1} << 20U, before.rlim_cur}) {
    const rlimit small{limit, before.rlim_max};
    ASSERT_EQ(::setrlimit(RLIMIT_STACK, &small), 0);
    std::size_t usual = 0, little = 0;
    Thread([&](const std::stop_token&) { usual = stack_of_this_thread(); }).join();
    Thread([&](const std::stop_token&) { little = stack_of_this_thread(); }, small_stack).join();
    // The system may give the larger stack of a thread that has ended.
    EXPECT_GE(usual, usual_stack);
    EXPECT_GE(little, small_stack);
  }
  ::setrlimit(RLIMIT_STACK, &before);
}

TEST(Threads, TheEndOfAThreadAsksItToStopAndWaits) {
  std::atomic<bool> was_asked = false;
  {
    const Thread thread([&](const std::stop_token& stop) {
      while (!stop.stop_requested()) ::usleep(1000);
      was_asked = true;
    });
  }
  EXPECT_TRUE(was_asked);
}

TEST(Threads, EachOfSeveralDoesItsOwnWork) {
  std::mutex mutex;
  std::set<int> done;
  start_threads(5, [&](int number) {
    const std::scoped_lock lock(mutex);
    done.insert(number);
  }).clear();
  EXPECT_EQ(done, (std::set<int>{0, 1, 2, 3, 4}));
}

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)  // they need terabytes of addresses themselves
TEST(Threads, WhereTheSystemGivesNoneThereIsASentenceAndWhereItGivesFewTheyDoTheWork) {
  // In a process of its own, which has room for some stacks, but none for a very large one.
  const pid_t child = ::fork();
  if (child == 0) {
    const rlimit memory{rlim_t{400} << 20U, rlim_t{400} << 20U};
    ::setrlimit(RLIMIT_AS, &memory);
    std::atomic<bool> over = false;
    auto threads = start_threads(10'000, [&](int) {
      while (!over) ::usleep(1000);
    });
    over = true;
    try {
      const Thread none([](const std::stop_token&) {}, std::size_t{1} << 30U);
    } catch (const SystemLimit& limit) {
      const bool is_told = std::string(limit.what()).find("gives no more threads") != std::string::npos;
      ::_exit(is_told && threads.size() < 10'000 ? 0 : 1);
    }
    ::_exit(2);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  EXPECT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 0);
}
#endif

}  // namespace
}  // namespace rheocyte::thread_test

// Each task is done once, by rank; what one throws reaches the caller.
#include "store/tasks.h"

#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>
#include <string>
#include <vector>

namespace rheocyte::tasks_test {
namespace {

class TasksOfThreads : public testing::TestWithParam<int> {};

TEST_P(TasksOfThreads, EachTaskIsDoneOnceThoseThatOthersAddToo) {
  constexpr int roots = 20, depth = 5;
  Tasks tasks;
  std::atomic<int> done = 0;
  std::vector<std::atomic<int>> by_thread(GetParam());
  const std::function<void(int, int)> grow = [&](int level, int thread) {
    ++done;
    ++by_thread[thread];
    for (int child = 0; child < 2 && level < depth; ++child)
      tasks.add(0, [&grow, level](int by) { grow(level + 1, by); });
  };
  for (int root = 0; root < roots; ++root) tasks.add(1, [&grow](int by) { grow(1, by); });
  tasks.run(GetParam());
  EXPECT_EQ(done, roots * ((1 << depth) - 1));
  int sum = 0;
  for (const auto& count : by_thread) sum += count;
  EXPECT_EQ(sum, done);
  EXPECT_GT(tasks.seconds(), 0);
  tasks.run(GetParam());  // nothing is left
  EXPECT_EQ(done, roots * ((1 << depth) - 1));
}

TEST_P(TasksOfThreads, AnExceptionDropsWhatWaitsAndReachesTheCallerWhenNoThreadIsLeft) {
  Tasks tasks;
  std::atomic<int> begun = 0, ended = 0;
  const auto add_many = [&](int rank) {
    for (int i = 0; i < 100; ++i) {
      tasks.add(rank, [&](int) {
        ++begun;
        ++ended;
      });
    }
  };
  add_many(0);
  tasks.add(1, [](int) { throw std::runtime_error("of a task"); });
  add_many(2);
  try {
    tasks.run(GetParam());
    ADD_FAILURE() << "nothing was thrown";
  } catch (const std::runtime_error& error) {
    EXPECT_EQ(std::string(error.what()), "of a task");
  }
  const int before = begun;
  EXPECT_EQ(ended, before);
  EXPECT_GE(before, 100);
  tasks.run(GetParam());  // neither the exception nor what was dropped comes again
  EXPECT_EQ(begun, before);
}

INSTANTIATE_TEST_SUITE_P(Threads, TasksOfThreads, testing::Values(1, 2, 4));

TEST(Tasks, OneThreadTakesThemByRankAndThenInTheirOrder) {
  Tasks tasks;
  std::string order;
  const auto add = [&](int rank, char name) { tasks.add(rank, [&order, name](int) { order += name; }); };
  add(2, 'd');
  add(1, 'b');
  add(2, 'e');
  tasks.add(0, [&](int) {
    order += 'a';
    add(1, 'c');
  });
  tasks.run(1);
  EXPECT_EQ(order, "abcde");
}

}  // namespace
}  // namespace rheocyte::tasks_test

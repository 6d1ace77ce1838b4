// Of builds without threads: the work is done when its thread is made.
#include <utility>

#include "store/thread.h"

namespace rheocyte {

const bool has_threads = false;

int processors() { return 1; }

namespace {

std::function<void()>& looks() {
  static std::function<void()> now;
  return now;
}

}  // namespace

BetweenTasks::BetweenTasks(const std::function<void()>& look) { looks() = look; }
BetweenTasks::~BetweenTasks() { looks() = nullptr; }

void look_between_tasks() {
  if (const auto& look = looks()) look();
}

Thread::Thread(Work work, std::size_t) { std::exchange(work, nullptr)(stop_.get_token()); }
Thread::~Thread() = default;
Thread::Thread(Thread&&) noexcept = default;
Thread& Thread::operator=(Thread&&) noexcept = default;
void Thread::join() {}

std::vector<Thread> start_threads(int wanted, const std::function<void(int)>& work) {
  for (int number = 0; number < wanted; ++number) work(number);
  return {};
}

}  // namespace rheocyte

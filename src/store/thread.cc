#include "store/thread.h"

#include <algorithm>
#include <memory>
#include <thread>
#include <utility>

#include "store/system_limit.h"

namespace rheocyte {

const bool has_threads = true;

int processors() { return std::max(1, int(std::thread::hardware_concurrency())); }

namespace {

struct Begin {
  Thread::Work work;
  std::stop_token stop;
};

extern "C" void* run_thread(void* begin) {
  const std::unique_ptr<Begin> own(static_cast<Begin*>(begin));
  own->work(own->stop);
  return nullptr;
}

}  // namespace

Thread::Thread(Work work, std::size_t stack_bytes) {
  std::stop_source stop;
  auto begin = std::make_unique<Begin>(Begin{std::move(work), stop.get_token()});
  pthread_attr_t attributes;
  ::pthread_attr_init(&attributes);
  ::pthread_attr_setstacksize(&attributes, stack_bytes);
  pthread_t started{};
  const int failed = ::pthread_create(&started, &attributes, run_thread, begin.get());
  ::pthread_attr_destroy(&attributes);
  if (failed) throw SystemLimit("threads", failed);
  static_cast<void>(begin.release());  // the thread owns it
  stop_ = std::move(stop);
  thread_ = started;
}

Thread::~Thread() {
  stop_.request_stop();
  join();
}

Thread::Thread(Thread&& other) noexcept
    : stop_(std::exchange(other.stop_, std::stop_source(std::nostopstate))),
      thread_(std::exchange(other.thread_, std::nullopt)) {}

Thread& Thread::operator=(Thread&& other) noexcept {
  Thread older(std::move(other));
  std::swap(stop_, older.stop_);
  std::swap(thread_, older.thread_);
  return *this;
}

// Another thread looks after the work.
BetweenTasks::BetweenTasks(const std::function<void()>&) {}
BetweenTasks::~BetweenTasks() = default;
void look_between_tasks() {}

void Thread::join() {
  if (thread_) ::pthread_join(*thread_, nullptr);
  thread_.reset();
}

std::vector<Thread> start_threads(int wanted, const std::function<void(int)>& work) {
  std::vector<Thread> threads;
  for (int number = 0; number < wanted; ++number) try {
      threads.emplace_back([work, number](const std::stop_token&) { work(number); });
    } catch (const SystemLimit&) {
      if (threads.empty()) throw;
      break;
    }
  return threads;
}

}  // namespace rheocyte

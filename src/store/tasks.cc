#include "store/tasks.h"

#include <chrono>
#include <utility>
#include <vector>

#include "store/system_limit.h"
#include "store/thread.h"

namespace rheocyte {

void Tasks::add(int rank, Task task) {
  {
    const std::lock_guard lock(mutex_);
    waiting_[rank].push_back(std::move(task));
  }
  changed_.notify_one();
}

Tasks::Task Tasks::next() {
  const auto first = waiting_.begin();
  Task task = std::move(first->second.front());
  first->second.pop_front();
  if (first->second.empty()) waiting_.erase(first);
  return task;
}

void Tasks::work(int thread) {
  using Clock = std::chrono::steady_clock;
  std::unique_lock lock(mutex_);
  for (;;) {
    changed_.wait(lock, [this] { return !waiting_.empty() || running_ == 0; });
    if (waiting_.empty()) break;
    Task task = next();
    ++running_;
    lock.unlock();
    look_between_tasks();
    const Clock::time_point start = Clock::now();
    std::exception_ptr failure;
    try {
      task(thread);
    } catch (...) {
      failure = std::current_exception();
    }
    task = nullptr;
    const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
    lock.lock();
    seconds_ += seconds;
    --running_;
    if (failure && !failure_) failure_ = failure;
    if (failure_) waiting_.clear();
  }
  changed_.notify_all();
}

void Tasks::run(int threads) {
  {
    std::vector<Thread> others;
    for (int thread = 1; thread < threads && has_threads; ++thread) try {
        others.emplace_back([this, thread](const std::stop_token&) { work(thread); });
      } catch (const SystemLimit&) {
        break;
      }
    work(0);
  }
  if (failure_) std::rethrow_exception(std::exchange(failure_, nullptr));
}

}  // namespace rheocyte

#include "serve/answer_threads.h"

#include <utility>

#include "store/system_limit.h"

namespace rheocyte {

AnswerThreads::AnswerThreads() { start(); }

AnswerThreads::~AnswerThreads() {
  {
    const std::scoped_lock lock(mutex_);
    is_over_ = true;
  }
  changed_.notify_all();
  threads_.clear();  // joins
}

bool AnswerThreads::take(std::function<void()> job) {
  const std::scoped_lock lock(mutex_);
  if (jobs_.size() >= most_waiting) return false;
  jobs_.push_back(std::move(job));
  if (jobs_.size() > idle_ && threads_.size() < most) try {
      start();
    } catch (const SystemLimit&) {  // those that are there do it later
    }
  changed_.notify_one();
  return true;
}

void AnswerThreads::start() {
  threads_.emplace_back([this](const std::stop_token&) { work(); }, small_stack);
}

void AnswerThreads::work() {
  std::unique_lock lock(mutex_);
  for (;;) {
    ++idle_;
    changed_.wait(lock, [this] { return is_over_ || !jobs_.empty(); });
    --idle_;
    if (jobs_.empty()) return;
    std::function<void()> job = std::move(jobs_.front());
    jobs_.pop_front();
    lock.unlock();
    job();
    job = {};
    lock.lock();
  }
}

}  // namespace rheocyte

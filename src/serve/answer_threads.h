// The threads in which answers are made.
#pragma once
#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <vector>

#include "store/thread.h"

namespace rheocyte {

/// Starts threads as they are needed and keeps them; what is more than the most, or than the system gives, waits for
/// one.
class AnswerThreads {
 public:
  static constexpr std::size_t most = 64, most_waiting = 1000;

  /// With one thread at least: SystemLimit if the system gives none.
  AnswerThreads();
  /// Does what waits, and ends.
  ~AnswerThreads();
  AnswerThreads(const AnswerThreads&) = delete;
  AnswerThreads& operator=(const AnswerThreads&) = delete;

  /// False if too many jobs wait already. A job throws nothing.
  bool take(std::function<void()> job);

 private:
  void start();
  void work();

  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<std::function<void()>> jobs_;
  std::size_t idle_ = 0;
  bool is_over_ = false;
  std::vector<Thread> threads_;
};

}  // namespace rheocyte

// Threads whose stack does not depend on the shell: those of the standard library have the limit of `ulimit -s`, and 2
// MB where it is unlimited.
#pragma once
#include <pthread.h>

#include <cstddef>
#include <functional>
#include <optional>
#include <stop_token>
#include <vector>

namespace rheocyte {

/// Whether this build has threads and processes (RHEOCYTE_PROCESSES). Without them work is done at once, in its place:
/// a thread has done its work when it has been made.
extern const bool has_threads;

/// Threads that the machine does at once, at least one.
int processors();

/// Of a thread, in bytes: for solving, and for what only waits, reads and writes text.
inline constexpr std::size_t usual_stack = std::size_t{8} << 20U, small_stack = std::size_t{2} << 20U;

class Thread {
 public:
  using Work = std::function<void(const std::stop_token&)>;

  Thread() = default;
  /// Begins the work. SystemLimit if the system gives no thread.
  explicit Thread(Work work, std::size_t stack_bytes = usual_stack);
  /// Asks the work to stop and waits for its end.
  ~Thread();
  Thread(Thread&& other) noexcept;
  Thread& operator=(Thread&& other) noexcept;

  /// Waits for its end.
  void join();

 private:
  std::stop_source stop_{std::nostopstate};
  std::optional<pthread_t> thread_;
};

/// In builds without threads what else is to be done meanwhile, such as to ask whether the work is still requested:
/// called between tasks (store/tasks.h) as long as this lives. Elsewhere never. One at a time.
class BetweenTasks {
 public:
  explicit BetweenTasks(const std::function<void()>& look);
  ~BetweenTasks();  // NOLINT(performance-trivially-destructible): without threads it has work to do
  BetweenTasks(const BetweenTasks&) = delete;
  BetweenTasks& operator=(const BetweenTasks&) = delete;
};
/// For those who do tasks.
void look_between_tasks();

/// Threads that do work(0), work(1), ...: as many as the system gives, at most `wanted`. SystemLimit if it gives none.
std::vector<Thread> start_threads(int wanted, const std::function<void(int number)>& work);

}  // namespace rheocyte

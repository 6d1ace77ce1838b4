#include "sweep/shared_work.h"

#include <algorithm>
#include <atomic>
#include <charconv>
#include <chrono>
#include <condition_variable>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <mutex>
#include <utility>
#include <vector>

#include "store/process_limits.h"
#include "store/thread.h"

namespace rheocyte {

namespace {

using namespace std::chrono_literals;

/// How often to look whether other processes have finished a piece, or were lost with one.
constexpr auto look = 100ms, look_again = 1000ms;

int number_in_environment(const char* name, int otherwise) {
  const char* text = std::getenv(name);
  int number = otherwise;
  if (text) std::from_chars(text, text + std::strlen(text), number);
  return number;
}

class Workers {
 public:
  Workers(const SharedWork& work, int jobs) : work_(work) {
    threads_ = start_threads(jobs, [this](int) { work_or_fail(); });
  }
  ~Workers() { stop(); }

  bool wait(const WorkObserver& observer, const std::atomic<bool>& wanted) {
    bool has_told = false;
    for (;;) {
      const int done = work_.done();
      if (observer.done) observer.done(done);
      std::unique_lock lock(mutex_);
      if (done == work_.pieces() || wanted || failure_) break;
      if (idle_ == int(threads_.size()) && observer.waits && !std::exchange(has_told, true)) observer.waits();
      changed_.wait_for(lock, look);
    }
    stop();
    if (failure_) std::rethrow_exception(failure_);
    return !wanted;
  }

 private:
  void stop() {
    {
      const std::lock_guard lock(mutex_);
      stop_ = true;
    }
    changed_.notify_all();
    threads_.clear();  // joins
  }

  void work_or_fail() {
    try {
      while (!stop_ && work_.done() < work_.pieces())
        if (!take_a_piece()) idle();
    } catch (...) {
      const std::lock_guard lock(mutex_);
      if (!failure_) failure_ = std::current_exception();
    }
    changed_.notify_all();
  }

  /// False if all that are missing are somebody else's.
  bool take_a_piece() {
    for (const int piece : work_.missing()) {
      if (stop_) break;
      const Claim claim = work_.claim(piece);
      if (!claim || work_.has(piece)) continue;  // somebody else works on it, or has just finished it
      work_.compute(piece, stop_);
      changed_.notify_all();
      return true;
    }
    return false;
  }

  void idle() {
    std::unique_lock lock(mutex_);
    ++idle_;
    changed_.wait_for(lock, look_again, [this] { return stop_.load(); });
    --idle_;
  }

  const SharedWork& work_;
  int idle_ = 0;
  std::atomic<bool> stop_ = false;
  std::exception_ptr failure_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<Thread> threads_;
};

}  // namespace

Rank rank_from_environment() {
  for (const auto& [rank, size] : {std::pair{"OMPI_COMM_WORLD_RANK", "OMPI_COMM_WORLD_SIZE"},
                                   {"PMI_RANK", "PMI_SIZE"},
                                   {"SLURM_PROCID", "SLURM_NTASKS"}}) {
    const int count = number_in_environment(size, 1), number = number_in_environment(rank, -1);
    if (number >= 0 && count > 1) return {number, count};
  }
  return {};
}

int available_processors(const Rank& rank) {
  const int all = processors();
  const int told = allowed_processors(), allowed = told > 0 ? told : all;
  if (rank.count <= 1) return allowed;
  const int not_bound = 1, bound = allowed < all ? allowed : not_bound;
  return std::clamp(number_in_environment("SLURM_CPUS_PER_TASK", bound), 1, allowed);
}

bool work_on(const SharedWork& work, int jobs, const WorkObserver& observer, const std::atomic<bool>& stop) {
  const int left = work.pieces() - work.done();
  return Workers(work, std::clamp(left, 1, jobs)).wait(observer, stop);
}

}  // namespace rheocyte

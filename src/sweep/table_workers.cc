#include "sweep/table_workers.h"

#include <sched.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdlib>
#include <exception>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

#include "state/outcome.h"
#include "store/thread.h"
#include "sweep/sample_branch.h"
#include "sweep/sample_square_branch.h"

namespace rheocyte {

namespace {

using namespace std::chrono_literals;

/// How often to look whether other processes have finished a branch, or were lost with one.
constexpr auto look = 100ms, look_again = 1000ms;

int number_in_environment(const char* name, int otherwise) {
  const char* text = std::getenv(name);
  return text && *text ? std::atoi(text) : otherwise;
}

bool is_stopped(const SampledBranch& branch) { return branch.end.status == Status::stopped; }

class Workers {
 public:
  Workers(const TableFolder& folder, int jobs) : folder_(folder) {
    threads_ = start_threads(jobs, [this](int) { work_or_fail(); });
  }
  ~Workers() { stop(); }

  bool wait(const TableObserver& observer, const std::atomic<bool>& wanted) {
    bool has_told = false;
    for (;;) {
      const int done = folder_.done();
      if (observer.done) observer.done(done);
      std::unique_lock lock(mutex_);
      if (done == folder_.branches() || wanted || failure_) break;
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
      while (!stop_ && folder_.done() < folder_.branches())
        if (!take_a_branch()) idle();
    } catch (...) {
      const std::lock_guard lock(mutex_);
      if (!failure_) failure_ = std::current_exception();
    }
    changed_.notify_all();
  }

  /// False if all that are missing are somebody else's.
  bool take_a_branch() {
    for (const BranchTask& task : folder_.missing()) {
      if (stop_) break;
      const Claim claim = folder_.claim(task.place);
      if (!claim || folder_.has(task.place, task.held)) continue;  // somebody else works on it, or has just finished it
      sample(task);
      changed_.notify_all();
      return true;
    }
    return false;
  }

  void sample(const BranchTask& task) {
    const TableSpec& spec = folder_.spec();
    const BranchPlace place = folder_.place(task.place);
    const SampledBranch branch = spec.is_square() ? (task.held ? sample_held_square_branch(spec, place, &stop_)
                                                               : sample_square_branch(spec, place, &stop_))
                                 : task.held      ? sample_held_branch(spec, folder_.branch(task.place, false), &stop_)
                                                  : sample_branch(spec, place, &stop_);
    if (!is_stopped(branch)) folder_.keep(task.place, branch, task.held);
  }

  void idle() {
    std::unique_lock lock(mutex_);
    ++idle_;
    changed_.wait_for(lock, look_again, [this] { return stop_.load(); });
    --idle_;
  }

  const TableFolder& folder_;
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

int available_processors() {
  cpu_set_t set;
  CPU_ZERO(&set);
  if (::sched_getaffinity(0, sizeof set, &set) == 0) return std::max(1, CPU_COUNT(&set));
  return std::max(1u, std::thread::hardware_concurrency());
}

bool work_on_table(const TableFolder& folder, int jobs, const TableObserver& observer, const std::atomic<bool>& stop) {
  const int left = folder.branches() - folder.done();
  return Workers(folder, std::clamp(left, 1, jobs)).wait(observer, stop);
}

}  // namespace rheocyte

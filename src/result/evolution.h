// A case in time in a thread of its own, whose frames wait until they are taken: for the view and for Python.
#pragma once
#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <deque>
#include <exception>
#include <functional>
#include <mutex>
#include <span>
#include <utility>
#include <vector>

#include "case/scales.h"
#include "result/judge_end.h"
#include "result/result_in_time.h"
#include "store/thread.h"

namespace rheocyte {

/// Item: what is kept of a frame until it is taken. The last state is judged as the command does it.
template <class Item>
class Evolution {
 public:
  /// Called in the thread that computes, with the frames so far in the record.
  using MakeItem = std::function<Item(const TimeFrame&, const Evolution&)>;

  /// With so many threads at most, where the work pays for them.
  Evolution(const Case& c, MakeItem make_item, int threads = 1)
      : result_{c, scales_of(c), problem_of(c), {}},
        run_(time_run_of(c, result_.scales)),
        make_item_(std::move(make_item)),
        limits_(&stop_, threads) {
    if (has_threads) thread_ = Thread([this](const std::stop_token&) { follow(); });
  }
  ~Evolution() {
    stop();
    thread_.join();
  }
  Evolution(const Evolution&) = delete;
  Evolution& operator=(const Evolution&) = delete;

  void stop() { stop_ = true; }

  /// Where there are no threads everything is computed here, and `at_item` is called after each item. Elsewhere
  /// nothing.
  void follow_here(std::function<void()> at_item) {
    if (has_threads) return;
    at_item_ = std::move(at_item);
    follow();
  }

  /// True once there are items or all is over.
  template <class Duration>
  bool wait_for(Duration duration) {
    std::unique_lock lock(mutex_);
    return changed_.wait_for(lock, duration, [this] { return is_over_ || !items_.empty(); });
  }
  bool is_over() const {
    const std::scoped_lock lock(mutex_);
    return is_over_;
  }
  std::size_t waiting() const {
    const std::scoped_lock lock(mutex_);
    return items_.size();
  }
  /// The first `most` of those that wait.
  std::deque<Item> take(std::size_t most = std::size_t(-1)) {
    const std::scoped_lock lock(mutex_);
    std::deque<Item> taken;
    for (; !items_.empty() && taken.size() < most; items_.pop_front()) taken.push_back(std::move(items_.front()));
    return taken;
  }

  const TimeRun& run() const { return run_; }
  /// Its state only once all is over.
  const Result& result() const { return result_; }
  /// Its frames for the thread that computes, all of it once all is over.
  const TimeRecord& record() const { return record_; }
  /// Of the steps so far.
  std::vector<HistoryRow> rows() const {
    const std::scoped_lock lock(mutex_);
    return record_.rows;
  }
  /// Of all steps, once they are known.
  std::vector<HistoryRow> row_errors() const {
    const std::scoped_lock lock(mutex_);
    return record_.row_errors;
  }
  /// Throws what the computation has thrown; once all is over.
  void check() const {
    if (failure_) std::rethrow_exception(failure_);
  }

 private:
  void follow() {
    try {
      result_.state = transient(result_.problem, run_, observer(), nullptr, limits_);
      judge_end(result_, record_, limits_);
      refuse_unfinite_numbers(result_);
    } catch (...) {
      failure_ = std::current_exception();
    }
    const std::scoped_lock lock(mutex_);
    is_over_ = true;
    changed_.notify_all();
  }

  TimeObserver observer() {
    const auto add_frame = [this](const TimeFrame& frame) {
      rheocyte::add_frame(frame, result_.scales, record_);
      add(make_item_(frame, *this));
      if (at_item_) at_item_();
    };
    const auto add_step = [this](const TimePoint& point, const TimeState&) {
      const std::scoped_lock lock(mutex_);
      rheocyte::add_step(point, result_.scales, record_);
    };
    const auto note_errors = [this](const TimeWay& errors) {
      const std::scoped_lock lock(mutex_);
      add_errors(errors, result_.scales, record_);
    };
    return {add_frame, add_step, note_errors};
  }

  void add(Item item) {
    const std::scoped_lock lock(mutex_);
    items_.push_back(std::move(item));
    changed_.notify_all();
  }

  Result result_;
  TimeRun run_;
  MakeItem make_item_;
  std::function<void()> at_item_ = {};
  TimeRecord record_;
  std::atomic<bool> stop_{false};
  WorkLimits limits_;
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<Item> items_;
  bool is_over_ = false;
  std::exception_ptr failure_;
  Thread thread_;
};

}  // namespace rheocyte

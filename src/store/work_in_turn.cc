#include "store/work_in_turn.h"

#include <utility>

#include "store/system_limit.h"

namespace rheocyte {

WorkInTurn::WorkInTurn() {
  if (is_in_place_) return;
  try {
    thread_ = Thread([this](const std::stop_token&) { work(); }, small_stack);
  } catch (const SystemLimit&) {
    is_in_place_ = true;
  }
}

WorkInTurn::~WorkInTurn() {
  {
    const std::lock_guard lock(mutex_);
    waiting_.clear();
    ends_ = true;
  }
  changed_.notify_all();
}

void WorkInTurn::check() const {
  if (failure_) std::rethrow_exception(failure_);
}

void WorkInTurn::add(Piece piece) {
  if (is_in_place_) return piece();
  {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return waiting_.size() < most_waiting || failure_; });
    check();
    waiting_.push_back(std::move(piece));
  }
  changed_.notify_all();
}

void WorkInTurn::finish() {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return (waiting_.empty() && !is_busy_) || failure_; });
  check();
}

void WorkInTurn::work() {
  std::unique_lock lock(mutex_);
  for (;;) {
    changed_.wait(lock, [this] { return !waiting_.empty() || ends_; });
    if (waiting_.empty()) return;
    Piece piece = std::move(waiting_.front());
    waiting_.pop_front();
    is_busy_ = true;
    lock.unlock();
    changed_.notify_all();
    std::exception_ptr failure;
    try {
      piece();
    } catch (...) {
      failure = std::current_exception();
    }
    piece = nullptr;
    lock.lock();
    is_busy_ = false;
    if (failure) failure_ = failure;
    if (failure_) waiting_.clear();
    changed_.notify_all();
  }
}

}  // namespace rheocyte

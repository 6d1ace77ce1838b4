// Pieces of work that another thread does in turn, while the thread that gives them goes on.
#pragma once
#include <condition_variable>
#include <deque>
#include <exception>
#include <functional>
#include <mutex>

#include "store/thread.h"

namespace rheocyte {

class WorkInTurn {
 public:
  using Piece = std::function<void()>;
  static constexpr std::size_t most_waiting = 2;

  WorkInTurn();
  /// Waits for the piece at hand; those that wait are dropped.
  ~WorkInTurn();
  WorkInTurn(const WorkInTurn&) = delete;
  WorkInTurn& operator=(const WorkInTurn&) = delete;

  /// Does the piece after those before it, by itself where the system has no thread for it. Waits while most_waiting
  /// pieces wait. Throws what an earlier piece has thrown; then no other one is done any more.
  void add(Piece piece);
  /// Waits until all are done. Throws in the same way.
  void finish();

 private:
  void work();
  void check() const;

  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<Piece> waiting_;
  bool is_busy_ = false, ends_ = false, is_in_place_ = !has_threads;
  std::exception_ptr failure_;
  Thread thread_;  // the last member: it is joined before the others go
};

}  // namespace rheocyte

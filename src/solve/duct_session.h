// The solver for one cell in a duct after another, as Session is for tubes: it keeps the last state with its factors.
#pragma once
#include <cstddef>
#include <memory>

#include "solve/stationary.h"

namespace rheocyte {

class DuctSolver;

/// Not for several threads at once.
class DuctSession {
 public:
  /// Of the factors only those are kept that take no more than this together, low degrees first; 0: nothing is kept.
  explicit DuctSession(std::size_t memory_limit_bytes);
  ~DuctSession();
  DuctSession(DuctSession&&) noexcept;
  DuctSession& operator=(DuctSession&&) noexcept;

  /// As Session::solve, for a problem in a duct.
  StationaryState solve(const Problem&, const ProgressCallback&, const std::atomic<bool>* stop);

  int warm_starts() const { return warm_starts_; }
  /// Of the factors that are kept.
  std::size_t memory_bytes() const;
  void forget();

 private:
  struct Kept;
  bool answer_nearby(DuctSolver&, Kept& answer, Status&);
  void solve(DuctSolver&, const Problem&, StationaryState&);
  void keep(Kept);

  std::size_t memory_limit_;
  std::unique_ptr<Kept> kept_;
  int warm_starts_ = 0;
};

}  // namespace rheocyte

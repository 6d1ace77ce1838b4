// The solver for one case after another: it keeps meshes, factors and states, and answers a case near an earlier one
// from there.
#pragma once
#include <cstddef>
#include <list>

#include "solve/duct_session.h"
#include "solve/ladder.h"
#include "solve/stationary.h"

namespace rheocyte {

/// Not for several threads at once: each has a session of its own.
class Session {
 public:
  /// Keeps states as long as their meshes and factors take no more than this, the latest ones; 0: none.
  explicit Session(std::size_t memory_limit_bytes = std::size_t(256) << 20)
      : memory_limit_(memory_limit_bytes), ducts_(memory_limit_bytes) {}

  /// The stationary state of a problem, from a kept one nearby or from the unstressed sphere; the answer is the same up
  /// to rounding and the tolerance of Newton's method. Never throws for a numerical failure: the state then holds the
  /// last converged shape on the branch and the outcome says why it stopped. `stop` is polled once an iteration; what
  /// was kept before stays.
  StationaryState solve(const Problem&, const ProgressCallback& = {}, const std::atomic<bool>* stop = nullptr);

  /// How many answers started from a kept state.
  int warm_starts() const { return warm_starts_ + ducts_.warm_starts(); }
  /// Of all that is kept, about.
  std::size_t memory_bytes() const;

 private:
  struct Kept {
    Problem problem;
    Ladder ladder;
  };
  /// The kept ladder moved to the problem, if one is near enough to be on the same branch.
  bool answer_nearby(const Problem&, const NewtonOptions&, SolveStatistics&, Kept& answer);
  void keep(Kept);
  /// The oldest ones, until the limit is met.
  void forget_tubes();
  /// What was being moved to the problem `from` when a stop was wanted becomes what it was.
  void take_back(Kept, const Problem& from);

  std::size_t memory_limit_;
  std::list<Kept> kept_;  ///< the latest first
  int warm_starts_ = 0;
  DuctSession ducts_;
};

}  // namespace rheocyte

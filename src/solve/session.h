// The solver for one case after another: it keeps meshes, factors and states, and answers a case near an earlier one
// from there.
#pragma once
#include <cstddef>
#include <list>
#include <span>

#include "solve/geometry.h"
#include "solve/ladder.h"
#include "solve/stationary.h"

namespace rheocyte {

class ResolvedBranch;

/// Not for several threads at once: each has a session of its own.
class Session {
 public:
  /// Keeps states as long as their meshes and factors take no more than this, the latest ones; 0: none. Of a state that
  /// takes more than this alone the factors of low degrees are kept.
  explicit Session(std::size_t memory_limit_bytes = std::size_t(256) << 20) : memory_limit_(memory_limit_bytes) {}

  /// The stationary state of a problem, from a kept one nearby or from the unstressed sphere; the answer is the same up
  /// to rounding and the tolerance of Newton's method. Never throws for a numerical failure: the state then holds the
  /// last converged shape on the branch and the outcome says why it stopped. A stop is looked for once an iteration;
  /// what was kept before stays. Lines: as by solve_stationary.
  StationaryState solve(const Problem&, const ProgressCallback& = {}, const WorkLimits& limits = {},
                        std::span<ProblemLine> = {});
  /// The same in a given geometry, at the given place.
  StationaryState solve_in(const Geometry&, const Problem&, const ProgressCallback& = {}, const WorkLimits& limits = {},
                           std::span<ProblemLine> = {});

  /// How many answers started from a kept state.
  int warm_starts() const { return warm_starts_; }
  /// Of all that is kept, about.
  std::size_t memory_bytes() const;

 private:
  struct Kept {
    Problem problem;
    decltype(Geometry::make) make;
    Ladder ladder;
    std::size_t memory_bytes() const;
  };
  /// The kept ladder moved to the problem, if one is near enough to be on the same branch: `converged` if so.
  Status answer_nearby(const Problem&, ResolvedBranch&, Ladder& answer);
  void keep(Kept);

  std::size_t memory_limit_;
  std::list<Kept> kept_;  ///< the latest first
  int warm_starts_ = 0;
};

}  // namespace rheocyte

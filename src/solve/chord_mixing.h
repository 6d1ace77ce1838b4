// Chord steps that learn from those before them what the kept tangent misses.
#pragma once
#include <vector>

#include "fem/nonlinear_system.h"

namespace rheocyte {

/// Enough for what moves between two steps in time; each costs two vectors.
inline constexpr int mixed_chord_steps = 6;

/// Before a chord step the combination of the last steps is taken that leaves the least residual (Anderson 1965; on a
/// linear problem this is GMRES with the kept factors as preconditioner).
class ChordMixing {
 public:
  /// 0 steps: plain chord steps.
  explicit ChordMixing(int steps) : steps_(std::size_t(steps)) {}

  /// To be added to `x`, whose residual is given.
  VectorXd correction(NonlinearSystem&, const VectorXd& x, const VectorXd& residual);
  /// Steps with other factors.
  void forget();

 private:
  struct Change {
    VectorXd x, residual;
  };

  std::size_t steps_;
  std::vector<Change> changes_;  ///< the oldest first
  Change last_;                  ///< the state before
};

}  // namespace rheocyte

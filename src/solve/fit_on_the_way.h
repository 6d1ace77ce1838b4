// A way along a branch on meshes that are fitted to the cell as it goes.
#pragma once
#include <cmath>
#include <utility>

#include "state/outcome.h"

namespace rheocyte {

/// Where a way has come to, and why it has stopped there: converged if it paused, or is at its end.
struct WayPoint {
  Status status;
  double parameter;
};

/// `go(pauses)` goes on as far as possible or, if it pauses, until the mesh is worn; `fit()` fits the mesh to the state
/// there, or returns false. A mesh is fitted where the way pauses, and where it would end before `end`; once only at
/// one place, and at an end only if `least_gain` was gained since the one before.
template <class Go, class Fit>
void fit_on_the_way(double end, const Go& go, const Fit& fit, double least_gain = 0) {
  double fitted_at = -HUGE_VAL, ended_at = -HUGE_VAL;
  for (WayPoint here = go(true); here.parameter < end;) {
    if (here.status == Status::stopped || here.status == Status::surface_unstable) return;
    const bool has_paused = here.status == Status::converged;
    const bool gains = has_paused || here.parameter >= std::exchange(ended_at, here.parameter) + least_gain;
    const bool is_fitted = gains && std::exchange(fitted_at, here.parameter) < here.parameter && fit();
    if (!is_fitted && !has_paused) return;
    here = go(is_fitted);
  }
}

}  // namespace rheocyte

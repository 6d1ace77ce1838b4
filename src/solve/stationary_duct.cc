#include "solve/stationary_duct.h"

#include "solve/duct_session.h"

namespace rheocyte {

StationaryState solve_in_duct(const Problem& problem, const ProgressCallback& progress, const std::atomic<bool>* stop) {
  return DuctSession(0).solve(problem, progress, stop);
}

}  // namespace rheocyte

#include "result/stationary_end.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace rheocyte {

namespace {

constexpr double share_of_time = 0.1, share_of_distance = 0.1;

std::string told(double deformation, double distance, bool settled) {
  const std::string text = fmt::format("The stationary shape has the deformation {:.5f}; the run ended {:.2g} % {} it",
                                       deformation, 100 * std::abs(distance), distance < 0 ? "below" : "above");
  return text + (settled ? ": the cell has settled, and that is the error of the mesh (time.degree)."
                         : ": it has not settled, or its mesh is too coarse (time.degree).");
}

}  // namespace

bool has_settled(const TimeRecord& record, double distance, double accuracy) {
  const double end = record.rows.back().t_us, d = record.rows.back().measure("deformation");
  double before = record.rows.front().measure("deformation");  // at the last step before the last tenth
  for (const HistoryRow& row : record.rows)
    if (row.t_us <= (1 - share_of_time) * end) before = row.measure("deformation");
  const double change = std::abs(d - before);
  return change < std::max(share_of_distance * distance, accuracy) * std::abs(d);
}

void compare_with_stationary(Result& result, TimeRecord& record, const std::atomic<bool>& stop) {
  Outcome& outcome = result.state.outcome;
  if (outcome.status != Status::converged || !result.problem.wall.is_straight() || record.rows.empty()) return;
  const StationaryState stationary = solve_stationary(result.problem, {}, &stop);
  if (stationary.outcome.status == Status::stopped) return;
  if (stationary.outcome.status != Status::converged) {
    outcome.message += " There is no stationary shape of this cell (" + std::string(name(stationary.outcome.status)) +
                       "): what seems to settle is held by the mesh.";
    return;
  }
  record.stationary_deformation = stationary.shape.deformation;
  const double distance = result.state.shape.deformation / stationary.shape.deformation - 1;
  const bool ended_early = record.rows.back().t_us < (1 - 1e-9) * *result.input.time.end_us;
  const bool settled = ended_early || has_settled(record, std::abs(distance), result.problem.accuracy);
  if (settled) result.state.estimated_error = std::abs(distance) + stationary.estimated_error;
  outcome.message = "The cell was followed " + std::string(ended_early ? "until it had settled. " : "to the end. ") +
                    told(stationary.shape.deformation, distance, settled);
}

}  // namespace rheocyte

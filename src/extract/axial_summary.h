// What `rheocyte moduli` says of the tension of the liquid along the flow that elongates the cells of a recording.
#pragma once
#include <string>
#include <vector>

#include "infer/common_tension.h"
#include "infer/slopes_between_cells.h"

namespace rheocyte {

/// Numbers alone (store/bytes.h).
struct AxialSummary {
  bool is_of_elongated_cells = false;  ///< whether the table is; else nothing else has a meaning
  bool is_given = false;               ///< the value, by the user
  CommonTension common;
  double wall_stress_Pa = no_value;  ///< see wall_shear_stress_Pa
  SlopesBetweenCells measured;
  PredictedSlopes predicted{};
};

/// Sentences for the terminal and for the table of events: the tension, and the slopes between cells as a test of the
/// model. None where the table is one of round cells.
std::vector<std::string> tension_lines(const AxialSummary& summary);
std::vector<std::string> slope_lines(const AxialSummary& summary);

/// Takes the events that have a cell of the table.
class SlopeTally {
 public:
  /// `errors`: of one picture of this cell.
  void take(const ShapeVector& seen, const ShapeErrors& errors, const CellCoordinates& cell);
  /// Measured, and predicted at the median cell.
  void finish(const CombinedInterpolation& table, AxialSummary& summary) const;

 private:
  std::vector<CellModes> modes_;         ///< less what pictures add on the mean
  ModeNoise noise_ = ModeNoise::Zero();  ///< sum of all
  std::vector<CellCoordinates> cells_;
};

}  // namespace rheocyte

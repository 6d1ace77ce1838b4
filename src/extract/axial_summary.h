// What `rheocyte moduli` says of all cells of a recording together: their stiffness, and the tension of the liquid
// along the flow that elongates them.
#pragma once
#include <string>
#include <utility>
#include <vector>

#include "events/events_beyond.h"
#include "infer/combined_population.h"
#include "infer/slopes_between_cells.h"

namespace rheocyte {

/// Numbers alone (store/bytes.h).
struct AxialSummary {
  bool is_of_elongated_cells = false;  ///< whether the table is; else nothing else has a meaning
  bool is_given = false;               ///< the tension, by the user
  LawOfCells law;
  EventsBeyond beyond;               ///< the table; where most are, there is no law
  double wall_stress_Pa = no_value;  ///< see wall_shear_stress_Pa
  SlopesBetweenCells measured;
  PredictedSlopes predicted{};

  bool has_tension() const { return is_given || law.is_found; }
};

/// Sentences for the terminal and for the table of events: tension and stiffness, and the slopes between cells as a
/// test of the model. None where the table is one of round cells.
std::vector<std::string> law_lines(const AxialSummary& summary);
std::vector<std::string> slope_lines(const AxialSummary& summary);

/// Ends of the 90 % interval of the tension; those of a given one are itself.
std::pair<double, double> tension_interval_Pa(const AxialTension& tension);
/// And of the median of the cells by a law.
std::pair<double, double> median_interval(const NumberOfLaw& number);

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

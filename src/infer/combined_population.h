// The population of cells with bulk, cortex and tension that a recording shows, by a combined table
// (docs/theory-populations.md, sec. "Several moduli").
#pragma once
#include <cmath>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "infer/bulk_cortex_fit.h"
#include "infer/combined_law.h"
#include "infer/combined_moments.h"
#include "infer/rendered_errors.h"
#include "infer/seen_cells.h"
#include "measurement/outline_noise.h"
#include "numeric/no_value.h"
#include "population/fit_moments.h"
#include "population/normal_nodes.h"
#include "store/watch.h"

namespace rheocyte {

/// How the cells of a recording are seen.
struct SeenPopulation {
  Sight sight;  ///< the viscosity does not count
  double pixel_size_um = 0;
  ValueGate log_area = {};                      ///< which measured areas are recorded at all
  OutlineNoise outline_noise = {};              ///< um
  std::optional<double> axial_tension_Pa = {};  ///< of all cells, if it is known
};

struct CombinedPopulation {
  MomentFit fit;  ///< `parameters` are a CombinedVector
  CombinedLaw law;
  CellsAtRest at_rest;  ///< in the channel and flow in which they are seen
  /// Of the parameters, by what all events have in common: table, section, and what these miss.
  Eigen::MatrixXd common_covariance;
  std::vector<int> features;            ///< that were fitted, of ShapeFeature
  Eigen::VectorXd residual;             ///< of their means, measured - fitted
  CellCoordinates mean_cell;            ///< of the law, in the table, which may end before
  std::vector<ShapeVector> drawn;       ///< virtual events of the law, which pass the gates
  std::vector<bool> counts;             ///< by event: it passes the gates, and is no stranger
  std::size_t smaller = 0, larger = 0;  ///< events that the gates leave out
  double kept_fraction = 1;             ///< of the cells, by the gates
  CellsBeyond beyond;                   ///< of the law, by numbers of cells that count as the table goes straight on
};

/// Of ln of a number among the cells of a population, by its law.
struct NumberOfLaw {
  double mean = no_value, variance = no_value;  ///< the variance is that of the mean by the scatter of the events
  double spread = no_value;                     ///< standard deviation between cells
  double common_error = no_value;               ///< standard error by what all events have in common
  /// Standard error of the mean.
  double error() const { return std::hypot(std::sqrt(variance), common_error); }
};
NumberOfLaw number_of_law(const CombinedPopulation& population, double CombinedLogs::*log);

/// What a recording says of all its cells together. Numbers alone (store/bytes.h).
struct LawOfCells {
  bool is_found = false;
  std::size_t cells = 0;     ///< from which it follows, or would have followed
  double misfit = no_value;  ///< chi squared of the mean features per degree of freedom
  AxialTension axial_tension = AxialTension::unknown();
  NumberOfLaw stiffness = {}, effective_modulus = {}, young = {}, cortex = {};  ///< kPa, but the last: mN/m
};
/// Of a population that was found.
LawOfCells law_of_cells(const CombinedPopulation& population, double wall_stress_Pa);

/// Of the ln of measured areas between limits, of which 0 and infinity are none.
ValueGate log_area_gate(double least_um2, double greatest_um2);

/// Fewer cells determine no population.
inline constexpr std::size_t fewest_cells_of_population = 20;

/// Of all cells, whichever of them the gates on the measured area keep; beside the given ones the sizes of the table
/// are such gates, if its cells have the median area. Not found: no cell of the table is like the median one, or the
/// events do not determine the parameters. Shapes in pixels and finite, in flows that differ from the sight's in the
/// viscosity alone. The order of the cells does not change a digit.
CombinedPopulation fit_combined_population(const BulkCortexFit& moduli, const SeenPopulation& seen,
                                           std::span<const MeasuredCell> cells, const Watch& watch);

}  // namespace rheocyte

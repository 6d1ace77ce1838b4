// The distribution of a recording's cells that makes its events most likely, and how far it is known
// (docs/theory-populations.md, sec. "Maximum and intervals").
#pragma once
#include <array>
#include <optional>

#include "population/likelihood.h"

namespace rheocyte {

/// Gates that keep less of the cells leave only a tail.
inline constexpr double least_kept_fraction = 0.05;

enum class FitState {
  fitted,
  too_stiff,  ///< the median measure is below its noise: there is a lower limit alone
  tail,       ///< nearly all cells would fail the gates
  not_found,  ///< no maximum was found
  singular    ///< the events do not determine all parameters
};

struct FitSettings {
  int threads = 1, nodes = usual_nodes;
  double level = 0.95;  ///< of the intervals
  bool with_shrunken = false;
};

/// NaN: there is no such end.
struct ParameterInterval {
  double lower, upper;
  bool is_profile = false;  ///< of the likelihood; else from the curvature at its maximum
};

/// Symmetric about a value whose error is normally distributed.
ParameterInterval normal_interval(double value, double standard_error, double level);

struct FittedCells {
  FitState state = FitState::not_found;
  CellLaw law;                                           ///< as the mean goes with the elongation
  CellDistribution cells;                                ///< of all elongations together
  ParameterMatrix covariance = ParameterMatrix::Zero();  ///< of their parameters
  std::array<ParameterInterval, population_parameters> intervals{};
  std::array<bool, population_parameters> at_bound{};  ///< such a parameter has no interval
  double log_likelihood = 0, kept_fraction = 1;
  double event_error = 0;                   ///< standard error of ln E of the median cell by a single image
  std::optional<double> least_log_modulus;  ///< of cells too stiff to be seen: the mean is above it at the level
  std::vector<ShrunkenCell> shrunken;       ///< if wanted, in the order of the sample

  double standard_error(PopulationParameter parameter) const;
};

/// At least one event, and all of them pass the gates of the sample (asserted).
FittedCells fit_cells(const Sample& sample, const FitSettings& settings);

}  // namespace rheocyte

// Whether a fitted population has the measures of its events, also those that were not fitted
// (docs/theory-populations.md, sec. "Checks").
#pragma once
#include <string>
#include <vector>

#include "extract/population_sample.h"
#include "extract/shape_verdict.h"
#include "population/fit_cells.h"

namespace rheocyte {

/// One measure of the events against that of the population, seen through pixels and gates.
struct MeasureCheck {
  std::string name;
  bool is_fitted = false;
  std::size_t events = 0;
  double distance = 0;  ///< of Kolmogorov and Smirnov: the greatest difference of the distributions
  Median measured;
  Median predicted;
  double spread = 0;                                            ///< robust standard deviation of the measured ones
  std::vector<double> measured_quantiles, predicted_quantiles;  ///< at check_places
  bool fits = true;
};
/// Shares at which the quantiles are told.
std::vector<double> check_places();
/// How much a measure may be off.
enum class MeasureRule {
  fitted,
  fitted_among_others,  ///< with fewer parameters than measures: as the next
  not_fitted,           ///< it has no parameters to follow chance with, and the laws of the pixels leave as much
  of_all_real_cells     ///< not fitted either, and a little off in most of them: the median alone counts
};
MeasureCheck compared_measure(std::string name, MeasureRule rule, std::vector<double> measured,
                              std::vector<double> predicted);

/// Of the events of the sample; the population is drawn with the elongations and viscosities of the events.
std::vector<MeasureCheck> check_population(const PopulationEvents& events, const PopulationSample& sample,
                                           const FittedCells& fitted, PopulationMaps& maps);

/// In words; what holds if all measures fit.
std::string check_text(const std::vector<MeasureCheck>& checks);

}  // namespace rheocyte

// Whether a measure of the events is that of a fitted population (docs/theory-populations.md, sec. "Checks").
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "extract/shape_verdict.h"

namespace rheocyte {

/// The events of a third of the areas.
struct ThirdCheck {
  std::size_t events = 0;
  double distance = 0;
  Median measured, predicted;
  bool fits = true;
};

/// One measure of the events against that of the population, seen through pixels and gates.
struct MeasureCheck {
  std::string name;
  bool is_fitted = false;
  std::size_t events = 0;
  /// Of Kolmogorov and Smirnov: the greatest difference of the distributions, which the convention of the masks may
  /// move.
  double distance = 0;
  Median measured;
  Median predicted;
  double spread = 0;                                            ///< robust standard deviation of the measured ones
  std::vector<double> measured_quantiles, predicted_quantiles;  ///< at check_places
  std::vector<ThirdCheck> thirds;                               ///< from small to large; none of few events
  bool fits_together = true;                                    ///< all events
  bool fits = true;                                             ///< also those of each third
};
/// Fractions at which the quantiles are given.
std::vector<double> check_places();
/// How much a measure may be off.
enum class MeasureRule {
  fitted,
  fitted_among_others,  ///< with fewer parameters than measures: as the next
  not_fitted,           ///< it has no parameters to follow chance with, and the laws of the pixels leave as much
  of_all_real_cells     ///< not fitted either, and a little off in most of them: the median alone counts
};

/// A measure of some events, and what divides these into thirds.
struct CheckedValues {
  std::vector<double> values, log_area;
};
/// `convention`: by how much all measured values may be off together, because of which pixels the masks contain.
MeasureCheck compared_measure(std::string name, MeasureRule rule, const CheckedValues& measured,
                              const CheckedValues& predicted, double convention = 0);

/// By how much a measure of a mask ("d", "c4" to "c7") depends on which pixels of the edge masks contain
/// (docs/theory-populations.md, eq:mask-convention), for cells of these areas; 0 of all other measures.
double mask_convention(std::string_view measure, double pixel_size_um, const std::vector<double>& log_area);

/// In words; what holds if all measures fit.
std::string check_text(const std::vector<MeasureCheck>& checks);

}  // namespace rheocyte

// The events of one recording as the estimator takes them.
#pragma once
#include <cstddef>
#include <limits>
#include <memory>
#include <vector>

#include "population/forward_map.h"

namespace rheocyte {

/// The greatest measure that passes, over ln of the measured area: linear between places of equal distance, constant
/// beyond them. Without places: no limit.
struct LimitCurve {
  double first = 0, step = 1;
  std::vector<double> values = {};

  double at(double log_area) const;
};

/// Which events are in the sample, by their measured values alone.
struct SampleGates {
  double least_log_area = -std::numeric_limits<double>::infinity(),
         greatest_log_area = std::numeric_limits<double>::infinity();
  double least_measure = -std::numeric_limits<double>::infinity(),
         greatest_measure = std::numeric_limits<double>::infinity();
  LimitCurve soft_end = {};

  bool pass(double log_area, double measure) const {
    return log_area > least_log_area && log_area < greatest_log_area && measure > least_measure &&
           measure < greatest_measure && measure < soft_end.at(log_area);
  }
};

/// One event, or several that lie in one bin: their number counts.
struct SampleEvent {
  double log_area = 0, measure = 0;
  double log_viscosity = 0;  ///< ln(mPa s), by which ln E is above that of the map
  double count = 1;
};

/// Events of equal elongation, which have a map of their own.
struct EventGroup {
  std::shared_ptr<const ForwardMap> map;
  std::vector<SampleEvent> events;
  double elongation = 0;  ///< from the mean of the sample, in its standard deviations
};

/// Events that have nearly the same chance to pass the gates, for cells of equal radius and modulus.
struct KeptClass {
  std::shared_ptr<const ForwardMap> map;
  SampleGates gates;
  double log_viscosity = 0;
  double count = 0;
  double elongation = 0, elongation_variance = 0;  ///< mean and variance of its events', as those of groups
};

struct Sample {
  std::vector<EventGroup> groups;
  std::vector<KeptClass> kept;
  /// What binning adds to the noise.
  double added_area_variance = 0, added_measure_variance = 0;

  double events() const;
  std::size_t bins() const;
  /// Whether all events have one elongation.
  bool is_of_one_elongation() const;
};

}  // namespace rheocyte

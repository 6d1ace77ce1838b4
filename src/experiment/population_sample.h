// The events of a recording, with the maps of its channel, as the estimator of populations takes them.
#pragma once
#include <vector>

#include "events/events_beyond.h"
#include "experiment/population_maps.h"
#include "population/sample.h"

namespace rheocyte {

struct SampleOptions {
  bool no_bins = false;
};

struct PopulationSample {
  Sample sample;
  /// Of each event of the sample: its place in PopulationEvents; empty if they are binned.
  std::vector<std::size_t> events;
  /// That of the map of each event, in the order of PopulationEvents; NaN: left out.
  std::vector<double> elongation_of_event;
  std::vector<double> class_elongation;  ///< of the classes in sample.kept
  std::vector<double> group_elongation;  ///< mean of the events of each of sample.groups
  /// Those of the sample are unit * (measured - mean).
  struct {
    double mean = 0, unit = 0;
  } elongation;
  EventsBeyond beyond;  ///< whose measured values the table does not have, or too nearly so
  /// Of each of the softer ones among them: ln(E / kPa) of the softest cell that the sample has at its size.
  std::vector<double> softer_than = {};
  bool is_binned = false;
};

PopulationSample population_sample(const PopulationEvents& events, PopulationMaps& maps, const SampleOptions& options);

/// The measure that gives the stiffness, and the one that gives the elongation.
const std::vector<double>& stiffness_measure(const PopulationEvents& events, StiffnessMeasure by);
const std::vector<double>& elongation_measure(const PopulationEvents& events, StiffnessMeasure by);

}  // namespace rheocyte

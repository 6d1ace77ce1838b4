// What holds of a recording and of all its events, whichever command reads it, and the remarks that follow.
#pragma once
#include <filesystem>
#include <string>
#include <tuple>
#include <vector>

#include "infer/modulus_map.h"
#include "measurement/recording.h"
#include "numeric/no_value.h"

namespace rheocyte {

/// Of the metadata, to distinguish recordings; empty where absent.
struct RecordingLabels {
  std::string sample, date, time, run_index, chip;

  /// For store/bytes.h.
  template <class Self>
  static auto fields(Self& s) {
    return std::tie(s.sample, s.date, s.time, s.run_index, s.chip);
  }
};
RecordingLabels labels_of(const Metadata& metadata);

/// Filled by EventReader (events/event_reader.h).
struct RecordingFacts {
  RecordingLabels labels;
  MeasuringConditions conditions;  ///< the viscosity is 0 where it varies from event to event
  double pixel_size_um = 0;        ///< 0 if unknown
  std::string medium;              ///< empty if the viscosity was given
  std::string viscosity_model, temperature;
  double temperature_C = no_value;       ///< of all events, or their median; NaN if the viscosity was given
  std::string range_of_viscosity_model;  ///< "18 to 28 degC"; empty without a model
  std::string area_from, deformation_from;
  std::string gates;    ///< limits of the events that count; empty: all
  std::string made_of;  ///< of a virtual recording: its own description of its cells (made_of_key)
  int direction = 0;    ///< in which the cells move (direction_of_cells.h); 0 also where outlines are not read
  std::size_t recorded = 0, gated = 0;
  std::size_t cut = 0;                  ///< outlines inside the gates that the edge of the picture cuts
  std::size_t outside_temperature = 0;  ///< events at which the viscosity model extrapolates
  std::size_t inertial = 0;             ///< events inside the gates with a Reynolds number above max_reynolds_number
  double greatest_reynolds_number = 0;  ///< of these
  std::vector<std::string> settings;    ///< channel, flow, pixels and viscosity, one line each
  std::vector<std::string> decisive;    ///< the same and the gates, in full (settings_hash.h)
  std::vector<std::string> notes;       ///< what the file and its settings contradict, in sentences

  /// For store/bytes.h.
  template <class Self>
  static auto fields(Self& s) {
    return std::tie(s.labels, s.conditions, s.pixel_size_um, s.medium, s.viscosity_model, s.temperature,
                    s.temperature_C, s.range_of_viscosity_model, s.area_from, s.deformation_from, s.gates, s.made_of,
                    s.direction, s.recorded, s.gated, s.cut, s.outside_temperature, s.inertial,
                    s.greatest_reynolds_number, s.settings, s.decisive, s.notes);
  }
};

/// The sentence about so many events whose outlines the edge of the picture cuts.
std::string cut_text(std::size_t events);

/// All that a user of any command must know of such a recording, in sentences without the file's name.
std::vector<std::string> remarks(const RecordingFacts&);

}  // namespace rheocyte

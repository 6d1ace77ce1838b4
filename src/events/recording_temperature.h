// Which temperature the liquid of a recording had: of each event, of the whole, or as the user says.
#pragma once
#include <string>
#include <vector>

#include "events/options.h"
#include "measurement/recording.h"
#include "numeric/no_value.h"

namespace rheocyte {

enum class TemperatureSource { none, given, metadata, feature };

/// Degrees Celsius at which a buffer flows and cells are measured. Programs store -1 or 0 where there is no sensor.
inline constexpr double lowest_temperature_C = 2, highest_temperature_C = 60;
inline bool is_possible_temperature(double celsius) {
  return celsius >= lowest_temperature_C && celsius <= highest_temperature_C;
}

struct RecordingTemperature {
  TemperatureSource from = TemperatureSource::none;
  double celsius = 0;                 ///< of all events, or the median of the possible ones
  double of_others = no_value;        ///< of single events without a possible one; NaN: they have none
  std::vector<std::string> warnings;  ///< sentences without the file's name
};

/// UserError if a temperature that is given is none of a buffer in a channel.
void check_temperatures(const MeasuringOptions& options);

/// As --temperature says; else of each event, else of the metadata, else as --temperature-if-missing says, each as far
/// as it is possible. Single events without one take that of the metadata, or the option's, if the option is given.
/// UserError if there is none.
RecordingTemperature temperature_of(const MeasuringOptions& options, const Recording& recording);

}  // namespace rheocyte

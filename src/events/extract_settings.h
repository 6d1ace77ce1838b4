// With which channel, flow and viscosity the events of one recording are taken: from the command line, else its
// metadata.
#pragma once
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "events/measured_ranges.h"
#include "events/options.h"
#include "events/recording_temperature.h"
#include "infer/modulus_map.h"
#include "measurement/recording.h"
#include "measurement/viscosity.h"
#include "numeric/no_value.h"

namespace rheocyte {

/// What is done about the pixels.
enum class PixelUse {
  correct,              ///< area and deformation, as far as the table wants it
  correct_deformation,  ///< the area stays as measured
  ignore,               ///< nothing is corrected; the size need not be known
  fit  ///< no correction beforehand: a fit to the contour takes account of them, so the size must be known
};

struct ExtractSettings {
  /// Pixel size 0: no correction. The viscosity is 0 if it varies from event to event; the exponent is that of the
  /// medium at the recording's temperature, 1: Newtonian or unknown.
  MeasuringConditions conditions;
  double pixel_size_um = 0;      ///< 0 if unknown
  std::optional<Buffer> buffer;  ///< nothing: the viscosity was given
  TemperatureSource temperature_from = TemperatureSource::none;
  double temperature_C = 0;                   ///< of all events, or their median
  double temperature_of_others_C = no_value;  ///< of single events without a possible one of their own; NaN: none
  std::vector<std::string> warnings;          ///< sentences without the file's name

  bool viscosity_varies() const { return temperature_from == TemperatureSource::feature; }
  /// Of events [first, first + mPas.size()) (mPa s); NaN for events without a possible temperature. Returns how many
  /// temperatures lie outside those for which the model was measured; there it extrapolates. UserError if the data are
  /// damaged.
  std::size_t viscosities(const Recording& recording, std::size_t first, std::span<double> mPas) const;
  /// What the moduli rest on, one line each: channel width, flow rate, size of a pixel if it counts, viscosity.
  std::vector<std::string> lines() const;
  std::string medium_text() const;       ///< "0.49% MC-PBS", or "" if the viscosity was given
  std::string model_text() const;        ///< "buyukurganci-2022", or "given"
  std::string temperature_text() const;  ///< "feature temp", "23 (metadata)", ""
  std::string range_text() const;        ///< for which the viscosity model was measured; there is a buffer (asserted)
};

/// The size of a pixel that is given, else that of the metadata. UserError if it is missing or cannot be so; `way_out`
/// names the options.
double pixel_size_um(const Recording& recording, const std::optional<double>& given, const char* way_out);

/// UserError naming what is missing and the option that gives it; also for recordings of the reservoir.
ExtractSettings extract_settings(const MeasuringOptions& options, PixelUse pixels, const Recording& recording);

}  // namespace rheocyte

// What is asked of the programs that work on recordings.
#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "case/choices.h"
#include "events/gate_options.h"

namespace rheocyte {

/// Which recordings, and where the results go.
struct BatchOptions {
  std::vector<std::filesystem::path> inputs;
  std::filesystem::path folder;  ///< of the results; empty: beside each recording
  bool recursive = false, quiet = false;
  int jobs = 0;  ///< recordings that are read at once; 0: as many as there are processors
};

/// How recordings were measured, and which of their events count. What is not given is taken from the recording.
struct MeasuringOptions {
  std::optional<double> channel_width_um, flow_rate_ul_s, pixel_size_um, viscosity_mPas;
  std::optional<std::string> medium, viscosity_model;
  std::string temperature;             ///< degC, "feature", "metadata", or empty: the feature if there is one
  std::string temperature_if_missing;  ///< degC where none is recorded; empty: such recordings are refused
  GateOptions gates;
  bool lifts_shape_gates = false;    ///< Gates::without_shapes
  std::optional<double> patience_s;  ///< not given: default_patience_s
};

/// A recording from which nothing was read for so long is given up.
inline constexpr double default_patience_s = 60;

struct ExtractOptions {
  BatchOptions batch;
  MeasuringOptions measuring;
  std::string table;  ///< a file, a folder of a table, or an identifier; empty: the tables that come with the program
  std::optional<Section> section;  ///< of these; not given: the square channel, if there are any
  bool no_pixelation = false, no_area_correction = false, no_tsv = false;
  bool no_asymmetry = false;               ///< contours and masks are not read where areas and deformations are stored
  std::optional<double> axial_tension_Pa;  ///< of the liquid, for the effective modulus; not given: found
};

struct ModuliOptions {
  BatchOptions batch;
  MeasuringOptions measuring;
  std::filesystem::path table;             ///< a combined one; empty: that which comes with the program
  bool fit_tension = false;                ///< as a third unknown
  std::optional<double> axial_tension_Pa;  ///< of the liquid; not given: found for each recording
  std::optional<double> outline_noise_um;  ///< OutlineNoise::deviation; not given: 0
  std::optional<Section> section;          ///< in which the cells were seen; not given: section_seen
};

struct TimeCourseOptions {
  BatchOptions batch;
  MeasuringOptions measuring;
  std::filesystem::path table, file;
  std::vector<double> contraction_um;  ///< one for all recordings, or one each
  std::optional<Section> section;      ///< in which the cells were seen; not given: section_seen
};

struct PopulationOptions {
  std::vector<std::string> conditions;  ///< NAME=FILE,FILE,...
  std::filesystem::path folder;         ///< of the results
  bool quiet = false;
  MeasuringOptions measuring;
  std::string model;               ///< solid, effective or cortex; empty: solid
  std::optional<Section> section;  ///< in which cells with a cortex were seen; not given: section_seen
  std::string table;               ///< of elongated cells, or a combined one; empty: that which comes with the program
  std::string by;                  ///< asymmetry, odd-deformation, deformation; empty: asymmetry
  std::vector<std::string> doses;  ///< NAME=VALUE, of conditions
  std::string dose_unit;           ///< in words
  bool paired = false;             ///< the recordings of each condition are of the same sessions, in order
  std::optional<double> between_recordings;  ///< known standard deviation of ln E
  bool shared_spread = false;                ///< of solids: the cells of all recordings of a condition scatter alike
  std::optional<double> outline_noise_um;    ///< OutlineNoise::deviation; not given: 0
  std::optional<double> axial_tension_Pa;    ///< of the liquid, for the effective modulus; not given: found
  bool no_bins = false;
  std::optional<double> jobs;  ///< threads
};

struct FeaturesOptions {
  BatchOptions batch;
  std::optional<double> pixel_size_um, patience_s;
};

/// UserError if a value is not a good one or two of them contradict.
void check_options(const MeasuringOptions& options);
void check_options(const ExtractOptions& options);

/// UserError if a table is given and a section by which one of the program's own is chosen.
void check_table(const std::string& table, const std::optional<Section>& section);

}  // namespace rheocyte

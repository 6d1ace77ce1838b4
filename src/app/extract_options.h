// The command line of `rheocyte extract`, and the parts of it that other commands on recordings have, too.
#pragma once
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "app/gates.h"

namespace CLI {
class App;
}

namespace rheocyte {

/// Which recordings, and where the results go.
struct BatchOptions {
  std::vector<std::filesystem::path> inputs;
  std::filesystem::path folder;  ///< of the results; empty: beside each recording
  bool recursive = false, quiet = false;
};

/// How recordings were measured, and which of their events count. What is not given is taken from the recording.
struct MeasuringOptions {
  std::optional<double> channel_width_um, flow_rate_ul_s, pixel_size_um, viscosity_mPas;
  std::optional<std::string> medium, viscosity_model;
  std::string temperature;  ///< degC, "feature", "metadata", or empty: the feature if there is one
  GateOptions gates;
  double patience_s = 60;
};

struct ExtractOptions {
  BatchOptions batch;
  MeasuringOptions measuring;
  std::string table;  ///< a file, a folder of a table, or an identifier; empty: the tables that come with the program
  bool no_pixelation = false, no_area_correction = false, no_tsv = false;
};

/// Declares FILES, -o, -r and --quiet.
void declare_batch_options(CLI::App& command, BatchOptions& options);

/// Declares those of channel, flow, pixel size, viscosity, temperature, gates and patience: every one of them has a
/// meaning for each command that calls this.
void declare_measuring_options(CLI::App& command, MeasuringOptions& options);
/// UserError if a value is not positive or two of them contradict.
void check_measuring_options(const MeasuringOptions& options);

/// Declares all options on the command; `run` is called when they are complete. UserError if they contradict.
void declare_extract_options(CLI::App& command, ExtractOptions& options, std::function<void()> run);

}  // namespace rheocyte

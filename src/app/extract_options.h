// The command line of `rheocyte extract`.
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

struct ExtractOptions {
  std::vector<std::filesystem::path> inputs;
  std::filesystem::path folder;  ///< of the results; empty: beside each recording
  bool recursive = false;
  std::string table;  ///< a file, a folder of a table, or an identifier; empty: the tables that come with the program
  std::optional<double> channel_width_um, flow_rate_ul_s, pixel_size_um, viscosity_mPas;
  std::optional<std::string> medium, viscosity_model;
  std::string temperature;  ///< degC, "feature", "metadata", or empty: the feature if there is one
  bool no_pixelation = false, no_area_correction = false, no_tsv = false, quiet = false;
  GateOptions gates;
  double patience_s = 60;
};

/// Declares those that say how a recording was measured: channel, flow, pixels, viscosity, temperature, patience.
void declare_measuring_options(CLI::App& command, ExtractOptions& options);
/// UserError if a value is not positive or two of them contradict.
void check_measuring_options(const ExtractOptions& options);

/// Declares all options on the command; `run` is called when they are complete. UserError if they contradict.
void declare_extract_options(CLI::App& command, ExtractOptions& options, std::function<void()> run);

}  // namespace rheocyte

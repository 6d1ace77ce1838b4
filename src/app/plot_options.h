// The command line of `rheocyte plot`.
#pragma once
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "app/extract_options.h"

namespace rheocyte {

struct PlotOptions {
  std::vector<std::filesystem::path> inputs;
  MeasuringOptions measuring;
  std::string table;               ///< as in ExtractOptions
  std::filesystem::path lines;     ///< a file of isoelasticity lines; empty: lines of the table
  std::vector<double> levels_kPa;  ///< of the lines, in the recording's channel; empty: spread over the picture
  std::string x = "area_um", y = "deform";  ///< features on the axes
  bool no_lines = false;                    ///< not even those of the program's own table
  bool no_pixelation = false;               ///< lines are drawn where they are without pixels
  bool quiet = false;
  std::filesystem::path output;  ///< as given, with or without .png or .svg; empty: beside the first recording
};

/// Whether the axes are those of lines of equal modulus.
inline bool has_usual_axes(const PlotOptions& options) { return options.x == "area_um" && options.y == "deform"; }

/// Declares the options on the command; `run` is called when they are complete. UserError if they contradict.
void declare_plot_options(CLI::App& command, PlotOptions& options, std::function<void()> run);

/// Name of the pictures without .png or .svg.
std::filesystem::path picture_stem(const PlotOptions& options);

}  // namespace rheocyte

// What is asked of a picture of recordings.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "events/options.h"

namespace rheocyte {

struct PlotOptions {
  std::vector<std::filesystem::path> inputs;
  MeasuringOptions measuring;
  std::string table;               ///< as in ExtractOptions
  std::optional<Section> section;  ///< as above
  std::filesystem::path lines;     ///< a file of isoelasticity lines; empty: lines of the table
  std::vector<double> levels_kPa;  ///< of the lines, in the recording's channel; empty: spread over the picture
  std::string x = "area_um", y = "deform";  ///< features on the axes
  bool shapes = false;                      ///< measured against expected inertia ratio
  bool no_lines = false;                    ///< not even those of the program's own table
  bool no_pixelation = false;               ///< lines are drawn where they are without pixels
  bool quiet = false;
  std::filesystem::path output;  ///< as given, with or without .png or .svg; empty: beside the first recording
};

/// Whether the axes are those of isoelasticity lines.
inline bool has_usual_axes(const PlotOptions& options) { return options.x == "area_um" && options.y == "deform"; }

}  // namespace rheocyte

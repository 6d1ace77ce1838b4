// A recording of cells that never were: population, shapes, camera, features, file.
#pragma once
#include <array>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "measurement/metadata.h"
#include "synth/cell_shapes.h"
#include "synth/synth_spec.h"

namespace rheocyte {

struct VirtualRecording {
  std::size_t cells = 0;                 ///< drawn
  std::size_t pictures = 0, events = 0;  ///< of them, a cell on its way at each of its places; and recorded ones
  std::array<std::size_t, names_of_missing_shapes.size()> missing{};  ///< pictures by NoShape
  double mean_area_error = 0;                                         ///< of the events: measured area / true area - 1
  double mean_deformation_error = 0;                                  ///< measured - true deformation
};

/// What is left out, of how many: "cells", or "pictures" of cells at several places.
std::string_view noun_of_missing(const VirtualRecording&);

/// By what the cells of a virtual recording are elongated; nothing if by the flow alone, or if it is not virtual.
std::optional<Elongation> elongation_of_cells(const Metadata&);

/// What else the file contains.
struct RecordingProvenance {
  std::string program;  ///< name and version
  std::string spec;     ///< the text of the spec, for the log
};

/// Draws the cells of the spec, lets `shapes` say what they look like, renders each to a mask of pixels at a random
/// place, measures the mask as a real one, and writes the recording. Features userdef1 to userdef6 (8 for combined
/// cells) hold the true values; their meanings are in the metadata "user:". Cells without a shape or outside the
/// picture are left out and counted. Calls `on_progress` from time to time. UserError if no cell is left, or for
/// whatever is wrong with writing.
VirtualRecording write_virtual_recording(const SynthSpec& spec, const CellShapes& shapes,
                                         const RecordingProvenance& provenance, const std::filesystem::path& file,
                                         const std::function<void(double)>& on_progress);

}  // namespace rheocyte

// Several moduli of each cell of one recording, from its contours or masks.
#pragma once
#include <filesystem>
#include <string>

#include "extract/moduli_summary.h"
#include "extract/options.h"
#include "infer/several_moduli.h"
#include "store/contained.h"

namespace rheocyte {

struct ModuliOptions {
  BatchOptions batch;
  MeasuringOptions measuring;
  std::filesystem::path table;  ///< folder of a combined table
  bool fit_tension = false;     ///< as a third unknown
  bool only_figure = false;     ///< by deformation and Lambda1 / Lambda2 in place of the whole contour
};

/// The text of a file with one line per event: E, E2D, tension, stiffness with standard errors, chi2, status.
struct ModuliResult {
  std::string text;
  ModuliSummary summary;
};

/// UserError for what is wrong with the recording; one that has neither contours nor masks is refused.
ModuliResult moduli_of_recording(const std::filesystem::path& recording, const ModuliOptions& options,
                                 const CombinedInterpolation& table, const FlowConditions& simulated,
                                 const TellProgress& tell_progress);

}  // namespace rheocyte

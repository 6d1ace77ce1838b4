// Several moduli of each cell of one recording, from its contours or masks.
#pragma once
#include <array>
#include <filesystem>
#include <string>

#include "app/contained.h"
#include "app/extract_options.h"
#include "infer/several_moduli.h"

namespace rheocyte {

struct ModuliOptions {
  ExtractOptions measuring;  ///< recordings, folder, table, channel, flow, viscosity, temperature, pixels
  bool fit_tension = false;  ///< as a third unknown
  bool only_figure = false;  ///< by deformation and Lambda1 / Lambda2 in place of the whole contour
};

/// The text of a file with one line per event: E, E2D, tension, stiffness with standard errors, chi2, status. UserError
/// for what is wrong with the recording; one that has neither contours nor masks is refused.
std::string moduli_text(const std::filesystem::path& recording, const ModuliOptions& options,
                        const CombinedInterpolation& table, const FlowConditions& simulated,
                        const TellProgress& tell_progress);

}  // namespace rheocyte

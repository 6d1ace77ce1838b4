// Several moduli of each cell of one recording, from its contours or masks.
#pragma once
#include <filesystem>

#include "extract/event_moduli.h"
#include "extract/moduli_summary.h"
#include "store/progress.h"

namespace rheocyte {

/// Writes a file with one line per event: E, E2D, tension, stiffness with standard errors, chi2, status. UserError for
/// what is wrong with the recording, which must have contours or masks, or with writing.
ModuliSummary moduli_of_recording(const std::filesystem::path& recording, const std::filesystem::path& file,
                                  const ModuliOptions& options, const ModuliTable& table,
                                  const TellProgress& tell_progress);

}  // namespace rheocyte

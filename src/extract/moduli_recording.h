// Several moduli of each cell of one recording, from its contours or masks.
#pragma once
#include <filesystem>
#include <string>

#include "extract/moduli_summary.h"
#include "extract/options.h"
#include "infer/several_moduli.h"
#include "store/progress.h"

namespace rheocyte {

struct ModuliOptions {
  BatchOptions batch;
  MeasuringOptions measuring;
  std::filesystem::path table;  ///< folder of a combined table
  bool fit_tension = false;     ///< as a third unknown
  bool only_figure = false;     ///< by deformation and Lambda1 / Lambda2 in place of the whole contour
};

/// A combined table, ready for use.
struct ModuliTable {
  /// UserError, also if the tension is to be fitted with a table of a single one.
  explicit ModuliTable(const ModuliOptions& options);
  ModuliTable(const ModuliTable&) = delete;
  ModuliTable& operator=(const ModuliTable&) = delete;

  CombinedTable content;
  CombinedInterpolation between;
  ChannelFlow simulated;
};

/// Writes a file with one line per event: E, E2D, tension, stiffness with standard errors, chi2, status. UserError for
/// what is wrong with the recording, which must have contours or masks, or with writing.
ModuliSummary moduli_of_recording(const std::filesystem::path& recording, const std::filesystem::path& file,
                                  const ModuliOptions& options, const ModuliTable& table,
                                  const TellProgress& tell_progress);

}  // namespace rheocyte

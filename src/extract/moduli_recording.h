// Several moduli of each cell of one recording, from its contours or masks.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "extract/event_moduli.h"
#include "extract/moduli_block.h"
#include "extract/moduli_summary.h"
#include "measurement/recording.h"
#include "store/progress.h"

namespace rheocyte {

/// Takes what is told of the events of a recording.
class ModuliConsumer {
 public:
  virtual ~ModuliConsumer() = default;
  /// Before the first event, with what holds for all of them in sentences.
  virtual void begin(const Recording& recording, const std::vector<std::string>& remarks) = 0;
  /// Of the events from `first` on, block after block.
  virtual void take(std::size_t first, const ModuliBlock& block) = 0;
  /// Behind the last event.
  virtual void end(const std::vector<std::string>& remarks) = 0;
};

/// Tells the consumer of each event: E, E2D, tension, stiffness with standard errors, chi2, status. UserError for what
/// is wrong with the recording, which must have contours or masks, and of the consumer. The cells of a block are shared
/// by up to so many threads; results do not depend on it.
ModuliSummary moduli_of_recording(const std::filesystem::path& recording, const ModuliOptions& options,
                                  const ModuliTables& tables, int threads, ModuliConsumer& consumer,
                                  const TellProgress& report_progress);

}  // namespace rheocyte

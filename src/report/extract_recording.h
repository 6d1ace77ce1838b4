// The files with the moduli of one recording: the companion that the field's programs open, and the table of events.
#pragma once
#include <filesystem>
#include <optional>

#include "events/options.h"
#include "extract/extract_summary.h"
#include "shelf/modulus_tables.h"
#include "store/progress.h"
#include "store/result_files.h"

namespace rheocyte {

/// Where the results of a recording go.
struct ExtractOutput {
  std::filesystem::path companion, events;  ///< .rtdc, .tsv
  /// Columns for which the field's programs have no name have their own in the companion: no place is too small for
  /// them, but only this program reads them.
  bool for_ourselves = false;
};

/// The files of one recording while they are written.
class ExtractFiles {
 public:
  /// Makes them empty, under hidden names. UserError, also if a file stands there that is not ours.
  ExtractFiles(const ExtractOutput& output, bool with_events);

  const std::filesystem::path& companion() const { return companion_; }
  /// Where the companion will stand.
  const std::filesystem::path& place() const { return place_; }
  bool for_ourselves() const { return for_ourselves_; }
  /// Nothing if no table of events is requested.
  const std::optional<std::filesystem::path>& events() const { return events_; }
  /// Puts all in their places, unless files that are not ours have come there meanwhile. UserError.
  void publish() { files_.publish(); }

 private:
  ResultFiles files_;
  std::filesystem::path place_, companion_;
  std::optional<std::filesystem::path> events_;
  bool for_ourselves_;
};

/// UserError if the options ask for something that the table does not have.
void check_against_tables(const ExtractOptions& options, const ModulusTables& tables);

/// Works through a recording in blocks, so that memory does not grow with it but for 12 bytes per event, and completes
/// the files, which the caller publishes. UserError for whatever is wrong with the recording or with writing. Calls
/// `on_progress` after each block.
ExtractSummary extract_recording(const std::filesystem::path& recording, const ExtractFiles& files,
                                 const ExtractOptions& options, const ModulusTables& tables,
                                 const TellProgress& on_progress);

}  // namespace rheocyte

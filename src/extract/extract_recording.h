// The moduli of one recording: read, compute, write the companion and the table of events.
#pragma once
#include <filesystem>
#include <functional>

#include "extract/extract_summary.h"
#include "extract/modulus_tables.h"
#include "extract/options.h"

namespace rheocyte {

/// Where the results of a recording go. While they are written, their names end in "~".
struct ExtractOutput {
  std::filesystem::path companion, events;  ///< .rtdc, .tsv
};

/// Name under which a file is written before it is complete.
std::filesystem::path unfinished(const std::filesystem::path& file);

/// Works through a recording in blocks, so that memory does not grow with it but for 8 bytes per event. UserError for
/// whatever is wrong with the recording or with writing. Calls `on_progress` after each block.
ExtractSummary extract_recording(const std::filesystem::path& file, const ExtractOutput& output,
                                 const ExtractOptions& options, const ModulusTables& tables,
                                 const std::function<void(double)>& on_progress);

}  // namespace rheocyte

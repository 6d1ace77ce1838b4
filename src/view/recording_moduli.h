// The moduli of a recording for the view: computed by the same work as `rheocyte extract`, into the same files.
#pragma once
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "extract/extract_recording.h"

namespace rheocyte {

/// {"summary": the columns of the summary table, "lines": what the command says on the terminal, "counts": events by
/// their states}.
nlohmann::ordered_json moduli_report(const std::filesystem::path& recording, const ExtractSummary& summary);

/// Of a table of events the lines of some events, whose numbers count from 0, with all remarks. UserError if they
/// cannot be written.
void copy_events_of_gate(const std::filesystem::path& table, const std::filesystem::path& target,
                         std::span<const std::size_t> numbers);

}  // namespace rheocyte

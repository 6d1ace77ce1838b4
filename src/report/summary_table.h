// The table with a line for each recording. Calls that write into one folder, also at the same time, add to one table.
#pragma once
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "extract/extract_summary.h"

namespace rheocyte {

/// One recording; `error` says why there is nothing else.
struct SummaryLine {
  std::filesystem::path recording;
  ExtractSummary summary;
  std::string error;
};

/// Tab-separated text with a header line: the lines, and those of the `earlier` text that are of other recordings, by
/// the recordings' names. Earlier columns of other names are left out.
std::string summary_table(std::span<const SummaryLine> lines, std::string_view earlier = {});

/// UserError if a file that is not ours stands where the summary shall be.
void check_place_of_summary(const std::filesystem::path& file);

/// Adds lines to a file, whose folder is made. Recordings below that folder are named as seen from there, others in
/// full. UserError, also if a file that is not ours stands there.
void add_to_summary(const std::filesystem::path& file, std::span<const SummaryLine> lines);

}  // namespace rheocyte

// What is reported of each recording, in the order of the summary table: for this table and for the view.
#pragma once
#include "extract/extract_summary.h"
#include "report/column.h"

namespace rheocyte {

/// Behind the name of the recording.
const Columns<ExtractSummary>& summary_columns();

/// What a column says of a recording; empty if that is nothing.
std::string summary_text(const Column<ExtractSummary>& column, const ExtractSummary& summary);

}  // namespace rheocyte

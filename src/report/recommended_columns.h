// Which modulus of a recording is to be reported: the columns of its summary that say so, for all who show it.
#pragma once
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "extract/extract_summary.h"
#include "report/column.h"

namespace rheocyte {

/// What the columns of the summary that begin with "recommended_" say, by their names without that word: "modulus"
/// ("none", "deformation", "elongated"), "young_modulus_median_kPa", "text", ...; null where a column says nothing.
nlohmann::ordered_json recommended_json(const ExtractSummary&);

/// The same for tables of events, "recommended_modulus: elongated" and so on, without columns that say nothing.
std::vector<std::string> recommended_lines(const ExtractSummary&);

/// In one line without the reason: "recommended: E = 4.21 +- 0.13 +- 0.064 kPa", or that there is none.
std::string recommended_in_short(const ExtractSummary&);

/// What a column of the summary says: a number, a text or null.
nlohmann::ordered_json summary_json(const Column<ExtractSummary>& column, const ExtractSummary&);

}  // namespace rheocyte

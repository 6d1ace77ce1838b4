// Which modulus of a recording is to be reported, for all who show it.
#pragma once
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "extract/extract_summary.h"
#include "report/column.h"

namespace rheocyte {

/// With this their names begin among the other columns of a summary.
inline constexpr const char* start_of_recommended = "recommended_";

/// "modulus" ("none", "deformation", "elongated"), "young_modulus_median_kPa" with its errors, "text", ...
const Columns<ExtractSummary>& recommended_columns();

/// By their names; null where a column has no value.
nlohmann::ordered_json recommended_json(const ExtractSummary&);

/// The same for tables of events, "recommended_modulus: elongated" and so on, without columns that have no value.
std::vector<std::string> recommended_lines(const ExtractSummary&);

/// In one line without the reason: "recommended: E = 4.21 +- 0.13 +- 0.064 kPa", or that there is none.
std::string recommended_in_short(const ExtractSummary&);

}  // namespace rheocyte

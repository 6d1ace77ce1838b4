// A paragraph for the methods section of a publication: how the numbers of a recording or an experiment were obtained.
#pragma once
#include <string>

#include "experiment/population_recordings.h"
#include "extract/extract_summary.h"

namespace rheocyte {

/// Of the recommended modulus of a recording; empty if there is none.
std::string methods_text(const ExtractSummary& summary);
/// Of a comparison of conditions, with the settings of its first recording; empty without a number.
std::string methods_text(const PopulationReport& report);

}  // namespace rheocyte

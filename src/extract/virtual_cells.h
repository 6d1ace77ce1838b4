// Virtual cells whose moduli are computed.
#pragma once
#include <string>

#include "measurement/metadata.h"
#include "shelf/modulus_tables.h"

namespace rheocyte {

/// What a virtual recording says of its cells (RecordingFacts::made_of), and which table has such ones: that by which
/// moduli are computed, or another one for a liquid of this exponent. Empty for other recordings.
std::string cells_made_of(const std::string& cells, const Metadata&, const ModulusTables&, const ModulusMap& table,
                          double exponent);

}  // namespace rheocyte

// One word for the settings that decide the numbers of a recording: outputs with the same hash are comparable.
#pragma once
#include <span>
#include <string>
#include <vector>

#include "events/extract_settings.h"
#include "events/gates.h"
#include "table/table_origin.h"

namespace rheocyte {

/// Raised with each change of a rule by which the same settings give other numbers, beyond rounding.
inline constexpr int version_of_rules = 1;

/// 16 hexadecimal digits, of the lines in their order and of version_of_rules. The lines contain what decides the
/// numbers: command, identifiers of tables, settings; neither paths nor what changes from recording to recording.
std::string settings_hash(std::span<const std::string> lines);

/// A table, by its identifier and what it was computed for.
std::string decisive_line(const TableOrigin& origin);

/// Channel, pixels, viscosity and gates, in full. Of a medium this is its name, the model and where temperatures come
/// from, not the temperature that was measured.
std::vector<std::string> decisive_lines(const ExtractSettings& settings, const Gates& gates);

}  // namespace rheocyte

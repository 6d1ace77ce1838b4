// What `rheocyte moduli` says about a recording, for programs.
#pragma once
#include <filesystem>
#include <string>
#include <string_view>

#include "extract/moduli_summary.h"

namespace rheocyte {

/// Units are in the names; null where there is no value (docs/theory-extract.md, sec. "The command").
std::string moduli_json(const std::filesystem::path& recording, const std::string& table, const ModuliSummary& summary);
/// With it all such files begin.
inline constexpr std::string_view mark_of_moduli_json = "{\n  \"made_by\": \"rheocyte moduli\"";

}  // namespace rheocyte

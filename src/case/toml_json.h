// A TOML text as JSON: for specifications that are no flat lists of numbers and words.
#pragma once
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

#include "case/case_text.h"

namespace rheocyte {

/// Keys and sections in the order of the file. UserError with the line if the text is no TOML, is harmful
/// (case/case_text.h) or has dates or times.
nlohmann::ordered_json json_of_toml(std::string_view text, const std::string& name, const TextKind& kind);

}  // namespace rheocyte

// Settings as JSON, and as options for a shell.
#pragma once
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "events/setting.h"

namespace rheocyte {

/// What may be given: of each setting {"name", "option", "label", "sentence", "kind", "unit", "least", "greatest",
/// "words", "default", "usual", "former"}; kind: "number", "text", "texts", "choice", "flag" or "numbers"; of a number
/// with words these may be given, too; of a text they are examples. Ends of a range that has none are null.
nlohmann::ordered_json declared_settings(const Settings&);

/// Puts values in their places: {"medium": "CellCarrier", "temperature": 23, "max": ["area_ratio=1.05"],
/// "no_pixelation": true}; null is not given. UserError naming the setting.
void take_settings(const Settings&, const nlohmann::ordered_json& given);

/// Those that are given, as take_settings reads them.
nlohmann::ordered_json given_settings(const Settings&);

/// Those that are given as options of a command, each behind a blank.
std::string options_text(const Settings&);

/// One word of a command for a shell.
std::string quoted_for_shell(const std::string& text);

}  // namespace rheocyte

// Isoelasticity lines for the plane of area and deformation.
#pragma once
#include <nlohmann/json_fwd.hpp>
#include <string>

namespace rheocyte {

/// {"lines": [{"young_modulus_kPa", "x", "y"}], "range": {"x", "y"}, "table", "sentence"} from what PlotLines draws.
nlohmann::ordered_json lines_json(const nlohmann::json& drawn, const std::string& sentence);
/// Without lines; the sentence gives the reason.
nlohmann::ordered_json no_lines_json(const std::string& sentence);

}  // namespace rheocyte

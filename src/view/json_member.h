// Members of the JSON that a request brings.
#pragma once
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

namespace rheocyte {

/// A text; the usual one if it is not given. Refused (400) if it is something else.
std::string text_member(const nlohmann::ordered_json& tree, std::string_view name, std::string_view usual = {});

/// An object; Refused (400) if it is not given or something else.
const nlohmann::ordered_json& object_member(const nlohmann::ordered_json& tree, std::string_view name);

}  // namespace rheocyte

// Members of JSON objects: those that a request brings, and one more of an answer.
#pragma once
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

namespace rheocyte {

/// A text; the usual one if it is not given. Refused (400) if it is something else.
std::string text_member(const nlohmann::ordered_json& tree, std::string_view name, std::string_view usual = {});

/// An object; Refused (400) if it is not given or something else.
const nlohmann::ordered_json& object_member(const nlohmann::ordered_json& tree, std::string_view name);

/// A list; an empty one if it is not given. Refused (400) if it is something else.
const nlohmann::ordered_json& list_member(const nlohmann::ordered_json& tree, std::string_view name);

/// Puts a member whose value is JSON already behind those of an object, without reading either.
void add_member(std::string& object, std::string_view name, std::string_view json);

}  // namespace rheocyte

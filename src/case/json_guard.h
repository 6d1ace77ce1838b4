// JSON and CBOR that others have written, checked before a tree is made of them.
#pragma once
#include <nlohmann/json.hpp>
#include <string_view>

namespace rheocyte {

/// Files of the field and of this program nest four levels deep.
inline constexpr int greatest_json_nesting = 32;

/// Whether the bytes are well-formed and nest no deeper: nlohmann's reader of CBOR, its output and its copies recurse.
bool is_sound_json(std::string_view bytes,
                   nlohmann::json::input_format_t format = nlohmann::json::input_format_t::json);

}  // namespace rheocyte

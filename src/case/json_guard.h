// JSON and CBOR that others have written, checked before a tree is made of them.
#pragma once
#include <nlohmann/json.hpp>
#include <string_view>

namespace rheocyte {

/// Files of the field and of this program nest four levels deep.
inline constexpr int max_json_nesting = 32;
/// Of one object: nlohmann's ordered objects look through all of them for each that is added.
inline constexpr int max_json_keys = 2000;

/// Whether the bytes are well-formed, nest no deeper (nlohmann's reader of CBOR, its output and its copies recurse) and
/// no object has more keys.
bool is_sound_json(std::string_view bytes,
                   nlohmann::json::input_format_t format = nlohmann::json::input_format_t::json);

/// A tree of what is sound, null of anything else.
nlohmann::ordered_json parse_sound_json(std::string_view text);

/// As text; bytes that are not UTF-8 are replaced. Written once, for each use of nlohmann's writer costs seconds of
/// compilation.
enum class JsonCharacters { utf8, ascii };
std::string json_text(const nlohmann::ordered_json&, JsonCharacters = JsonCharacters::utf8);
/// The same without line breaks.
std::string json_line(const nlohmann::ordered_json&);

}  // namespace rheocyte

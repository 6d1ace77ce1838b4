// Names of files in JSON: bytes that are no UTF-8 are written there as the lone surrogates \udc80 to \udcff, which
// Python takes for such bytes, too (PEP 383). In memory a character from the end of Unicode's private use stands for
// each.
#pragma once
#include <string>

namespace rheocyte {

/// Bytes as valid UTF-8, and back.
std::string with_stand_ins(const std::string& bytes);
std::string without_stand_ins(const std::string& text);

/// The same of whole documents of JSON: stand-ins become escapes, and back.
std::string stand_ins_escaped(const std::string& json_text);
std::string escapes_as_stand_ins(const std::string& json_text);

}  // namespace rheocyte

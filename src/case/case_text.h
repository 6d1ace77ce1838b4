// The bytes of a case file or a specification, guarded before any parser sees them.
#pragma once
#include <filesystem>
#include <string>
#include <string_view>

namespace rheocyte {

/// A case has some twenty lines; more than this is a mistake or an attack.
inline constexpr std::size_t max_case_bytes = 1 << 20;

/// Brackets inside brackets, and parts of a dotted key. toml++ 3.3 recurses on both without a safe bound.
inline constexpr int max_nesting = 16;

/// How messages call a text, and what may stand in it.
struct TextKind {
  std::string_view noun = "case", file = "case file", example = "case.toml";
  std::string_view help = "case";  ///< of `rheocyte help`
  bool has_names = false;          ///< strings hold names of files and other things, of any characters
};
/// A specification of this help.
constexpr TextKind specification(std::string_view help, bool has_names = false) {
  return {"specification", "specification", "spec.toml", help, has_names};
}

/// Reads a regular file of at most max_case_bytes. UserError: missing, folder, pipe, unreadable, too large.
std::string read_case_text(const std::filesystem::path&, const TextKind& kind = {});

/// UserError if the text is empty, no UTF-8, holds a zero byte, nests too deep, or has a character beyond ASCII outside
/// of comments, and of strings that hold names: nothing else in it has one, and toml++ 3.3 meets some of them with
/// undefined behaviour. `name` stands in the message.
void check_case_text(std::string_view text, const std::string& name, const TextKind& kind = {});

}  // namespace rheocyte

#include "case/case_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <fstream>

#include "case/user_error.h"
#include "case/utf8.h"

namespace rheocyte {

namespace fs = std::filesystem;

namespace {

constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";

long line_of(std::string_view text, std::size_t position) {
  return 1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(position), '\n');
}

// Walks over the text as TOML's lexer would: follows the nesting outside of comments and strings, and looks for
// characters beyond ASCII outside of comments, and of strings that hold names. Where the text is no valid TOML the walk
// may go astray, but only behind the place at which the parser stops.
class LexicalScan {
 public:
  enum class Finding { none, too_deep, not_ascii };

  LexicalScan(std::string_view text, const TextKind& kind)
      : text_(text), has_names_(kind.has_names), at_(text.starts_with(byte_order_mark) ? 3 : 0) {}

  // Stops at the first finding.
  Finding run() {
    while (at_ < text_.size()) {
      if (is_beyond_ascii(text_[at_])) return Finding::not_ascii;
      step();
      if (depth_ > max_nesting || dots_ >= max_nesting) return Finding::too_deep;
    }
    return Finding::none;
  }

  // Of the first byte of the character at which run() stopped.
  std::size_t position() const { return start_of_character(text_, std::min(at_, text_.size() - 1)); }

 private:
  void step() {
    const char c = text_[at_];
    if (c == '#') return skip_to("\n");
    if (c == '"' || c == '\'') return skip_string(c);
    if (c == '[' || c == '{') ++depth_;
    if (c == ']' || c == '}') --depth_;
    if (c == '.') ++dots_;
    if (std::strchr(",=[]{}\n", c)) dots_ = 0;  // a dotted key, or a number, ends here
    ++at_;
  }

  void skip_string(char quote) {
    const std::string triple(3, quote);
    if (text_.substr(at_, 3) == triple) {
      at_ += 3;
      skip_past(triple, quote);
      while (at_ < text_.size() && text_[at_] == quote) ++at_;  // up to two quotes may end the string's own text
    } else {
      ++at_;
      skip_past(std::string(1, quote), quote);
    }
  }

  void skip_past(const std::string& end, char quote) {
    while (at_ < text_.size() && text_.substr(at_, end.size()) != end) {
      if (is_beyond_ascii(text_[at_]) && !has_names_) return;  // a finding
      if (end.size() == 1 && text_[at_] == '\n') return;       // an open string: the parser stops here
      at_ += quote == '"' && text_[at_] == '\\' ? 2 : 1;
    }
    at_ += end.size();
  }

  void skip_to(std::string_view end) { at_ = std::min(text_.find(end, at_), text_.size()); }

  std::string_view text_;
  bool has_names_;
  std::size_t at_;
  int depth_ = 0, dots_ = 0;
};

[[noreturn]] void refuse(const std::string& name, const std::string& reason) { throw UserError(name + ": " + reason); }

}  // namespace

std::string read_case_text(const fs::path& file, const TextKind& kind) {
  const std::string name = file.string();
  std::error_code error;
  const auto status = fs::status(file, error);
  if (status.type() == fs::file_type::not_found) refuse(name, fmt::format("there is no such {}.", kind.file));
  if (error) refuse(name, fmt::format("cannot read the {} ({}).", kind.file, error.message()));
  if (fs::is_directory(status))
    refuse(name, fmt::format("is a folder; give the {} itself, for example {}.", kind.file, kind.example));
  if (!fs::is_regular_file(status))
    refuse(name, fmt::format("is not a regular file; write the {} to a file first.", kind.noun));
  const auto too_large = [&] {
    refuse(name, fmt::format("the {} is larger than {} KiB; a {} has some twenty lines.", kind.file,
                             max_case_bytes / 1024, kind.noun));
  };
  if (fs::file_size(file, error) > max_case_bytes || error) too_large();

  std::ifstream stream(file, std::ios::binary);
  if (!stream) refuse(name, fmt::format("cannot read the {} ({}).", kind.file, std::strerror(errno)));
  std::string text(max_case_bytes + 1, '\0');
  stream.read(text.data(), static_cast<std::streamsize>(text.size()));
  if (stream.bad()) refuse(name, fmt::format("reading the {} failed.", kind.file));
  text.resize(static_cast<std::size_t>(stream.gcount()));
  if (text.size() > max_case_bytes) too_large();  // it has grown since the first look
  return text;
}

void check_case_text(std::string_view text, const std::string& name, const TextKind& kind) {
  if (text.find_first_not_of(" \t\r\n") == std::string_view::npos)
    refuse(name, fmt::format("the {} is empty; `rheocyte help {}` lists its keys.", kind.file, kind.help));
  const auto refuse_at = [&](std::size_t position, const std::string& what) {
    refuse(fmt::format("{}:{}", name, line_of(text, position)), what);
  };
  const auto refuse_byte = [&](std::size_t position, std::string_view byte) {
    refuse_at(position, fmt::format("{}; a {} is a text file in TOML, saved as UTF-8.", byte, kind.noun));
  };
  if (const auto zero = text.find('\0'); zero != std::string::npos) refuse_byte(zero, "a zero byte");
  if (const auto bad = first_bad_byte(text); bad != std::string_view::npos)
    refuse_byte(bad, "a byte that is not UTF-8");
  LexicalScan scan(text, kind);
  const auto finding = scan.run();
  if (finding == LexicalScan::Finding::too_deep)
    refuse_at(scan.position(), fmt::format("nested deeper than {} levels; a {} needs three.", max_nesting, kind.noun));
  if (finding == LexicalScan::Finding::not_ascii)
    refuse_at(scan.position(), fmt::format("the character {} can only stand in a comment{}.",
                                           text.substr(scan.position(), sequence_length(text[scan.position()])),
                                           kind.has_names ? " or within quotes" : ""));
}

}  // namespace rheocyte

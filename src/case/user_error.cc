#include "case/user_error.h"

#include "case/utf8.h"

namespace rheocyte {

namespace {

constexpr std::size_t longest_sentence = 800;

}  // namespace

std::string one_line(std::string_view text, std::size_t longest) {
  std::size_t end = text.size();
  if (end > longest) end = start_of_character(text, longest);  // never cut a character in two
  std::string line(text.substr(0, end));
  for (char& c : line)
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7F) c = '?';
  return end < text.size() ? line + "..." : line;
}

UserError::UserError(const std::string& sentence) : std::runtime_error(one_line(sentence, longest_sentence)) {}

}  // namespace rheocyte

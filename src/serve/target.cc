#include "serve/target.h"

#include <algorithm>
#include <charconv>

namespace rheocyte {

namespace {

enum class Plus { stays, is_blank };

std::string decoded(std::string_view text, Plus plus) {
  std::string clear;
  clear.reserve(text.size());
  for (std::size_t i = 0; i < text.size(); ++i) {
    unsigned char byte = 0;
    const bool has_digits = text[i] == '%' && i + 2 < text.size();
    if (has_digits && std::from_chars(text.data() + i + 1, text.data() + i + 3, byte, 16).ptr == text.data() + i + 3) {
      clear += static_cast<char>(byte);
      i += 2;
    } else {
      clear += text[i] == '+' && plus == Plus::is_blank ? ' ' : text[i];
    }
  }
  return clear;
}

}  // namespace

Target read_target(std::string_view text) {
  text = text.substr(0, text.find('#'));
  const std::size_t end = std::min(text.find('?'), text.size());
  Target target{decoded(text.substr(0, end), Plus::stays), {}};
  for (text.remove_prefix(std::min(end + 1, text.size())); !text.empty();) {
    const std::string_view pair = text.substr(0, text.find('&'));
    const std::size_t equals = std::min(pair.find('='), pair.size());
    if (!pair.empty())
      target.query.insert_or_assign(decoded(pair.substr(0, equals), Plus::is_blank),
                                    decoded(pair.substr(std::min(equals + 1, pair.size())), Plus::is_blank));
    text.remove_prefix(std::min(pair.size() + 1, text.size()));
  }
  return target;
}

}  // namespace rheocyte

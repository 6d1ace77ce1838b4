#include "view/page_words.h"

#include <algorithm>
#include <cctype>
#include <string_view>

#include "events/recording_settings.h"

namespace rheocyte {

namespace {

bool is_of_a_name(char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '-' || c == '_'; }

/// The label of the setting's field.
std::string word_for(const std::string& option) {
  ExtractOptions none;
  const Settings settings = settings_of(none);
  const auto setting = std::ranges::find(settings, option, [](const Setting& each) { return option_of(each); });
  return setting == settings.end() ? option : std::string(setting->label);
}

}  // namespace

std::string in_words_of_page(const std::string& sentence) {
  std::string text;
  for (std::size_t at = 0; at < sentence.size();) {
    const bool begins = at == 0 || std::string_view(" (").find(sentence[at - 1]) != std::string_view::npos;
    std::size_t end = at;
    if (begins && sentence.compare(at, 2, "--") == 0)
      while (end < sentence.size() && is_of_a_name(sentence[end])) ++end;
    const bool is_option = end > at + 2;
    if (!is_option) end = at + 1;
    const auto piece = sentence.substr(at, end - at);
    text += is_option ? word_for(piece) : piece;
    at = end;
  }
  return text;
}

}  // namespace rheocyte

#include "view/page_words.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <string_view>
#include <utility>

namespace rheocyte {

namespace {

using PageWord = std::pair<std::string_view, std::string_view>;

// Fields as page/src/recordings/ModuliPanel.tsx labels them; what the page has no field for, the command has.
constexpr std::array<PageWord, 14> words_of_page{{{"--table", "Table"},
                                                  {"--medium", "Medium"},
                                                  {"--temperature", "Temperature"},
                                                  {"--temperature-if-missing", "Temperature if missing"},
                                                  {"--viscosity-mPas", "Viscosity"},
                                                  {"--min", "a gate"},
                                                  {"--max", "a gate"},
                                                  {"--polygon", "a polygon"},
                                                  {"--channel-width-um", "rheocyte extract --channel-width-um"},
                                                  {"--flow-rate-ul-s", "rheocyte extract --flow-rate-ul-s"},
                                                  {"--pixel-size-um", "rheocyte extract --pixel-size-um"},
                                                  {"--viscosity-model", "rheocyte extract --viscosity-model"},
                                                  {"--no-pixelation", "rheocyte extract --no-pixelation"},
                                                  {"--no-area-correction", "rheocyte extract --no-area-correction"}}};

bool is_of_a_name(char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '-' || c == '_'; }

std::string_view word_for(std::string_view option) {
  const auto found = std::ranges::find(words_of_page, option, &PageWord::first);
  return found != words_of_page.end() ? found->second : option;
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
    const auto piece = std::string_view(sentence).substr(at, end - at);
    text += is_option ? word_for(piece) : piece;
    at = end;
  }
  return text;
}

}  // namespace rheocyte

// Sentences of the commands in the words of the page.
#pragma once
#include <string>

namespace rheocyte {

/// The sentence with the names of the page's fields in place of options that it has ("Temperature" for
/// "--temperature"); an option that it does not have is named with its command ("rheocyte extract --pixel-size-um").
std::string in_words_of_page(const std::string& sentence);

}  // namespace rheocyte

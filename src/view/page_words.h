// Sentences of the commands in the words of the page.
#pragma once
#include <string>

namespace rheocyte {

/// The sentence with the labels of the page's fields in place of the options of settings: "Temperature" for
/// "--temperature".
std::string in_words_of_page(const std::string& sentence);

}  // namespace rheocyte

// For Windows with libstdc++, before any path is made from a text: paths from narrow texts are UTF-8 there, too. Its
// own way is that of the C locale, in which each byte is a character, though it gives paths as UTF-8.
#pragma once
#include <filesystem>
#include <string_view>

#if defined(_WIN32) && defined(_GLIBCXX_RELEASE)
template <>
inline auto std::filesystem::path::_S_convert<char>(const char* first, const char* last) {
  return std::filesystem::__detail::__wstr_from_utf8(std::string_view(first, static_cast<std::size_t>(last - first)));
}
#endif

#include <fcntl.h>
#include <io.h>
#include <windows.h>

#include "store/program.h"
// After it.
#include <shellapi.h>

#include <algorithm>
#include <cstdio>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "store/windows_errors.h"

namespace rheocyte {

namespace {

/// The paths that a word with stars or question marks in its last part stands for: shells of Windows leave them to the
/// programs. The word itself where there are none.
std::vector<std::string> paths_of(const wchar_t* word) {
  const std::wstring_view text(word);
  const std::size_t name = text.find_last_of(L"/\\:") + 1;  // 0 where there is no folder
  std::vector<std::string> paths;
  if (!text.starts_with(L'-') && text.find_first_of(L"*?", name) != std::wstring_view::npos) {
    WIN32_FIND_DATAW found;
    if (const HANDLE search = ::FindFirstFileW(word, &found); search != INVALID_HANDLE_VALUE) {
      do {
        if (std::wstring_view(found.cFileName) != L"." && std::wstring_view(found.cFileName) != L"..")
          paths.push_back(narrow((std::wstring(text.substr(0, name)) + found.cFileName).c_str()));
      } while (::FindNextFileW(search, &found));
      ::FindClose(search);
    }
  }
  std::ranges::sort(paths);
  if (paths.empty()) paths.push_back(narrow(word));
  return paths;
}

std::vector<std::string> arguments_in_utf8() {
  int count = 0;
  wchar_t** const words = ::CommandLineToArgvW(::GetCommandLineW(), &count);
  std::vector<std::string> arguments;
  for (int i = 0; words && i < count; ++i)
    for (std::string& path : paths_of(words[i])) arguments.push_back(std::move(path));
  ::LocalFree(words);
  return arguments;
}

}  // namespace

char** begin_program(int& count, char** arguments) {
  _fmode = _O_BINARY;
  for (std::FILE* stream : {stdin, stdout, stderr}) ::_setmode(::_fileno(stream), _O_BINARY);
  ::SetConsoleOutputCP(CP_UTF8);
  static std::vector<std::string> words = arguments_in_utf8();
  static std::vector<char*> pointers;
  if (words.empty()) return arguments;
  for (auto& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  count = static_cast<int>(words.size());
  return pointers.data();
}

}  // namespace rheocyte

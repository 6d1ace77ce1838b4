#include <fcntl.h>
#include <io.h>
#include <windows.h>

#include "store/program.h"
// After it.
#include <shellapi.h>

#include <cstdio>
#include <string>
#include <vector>

#include "store/windows_errors.h"

namespace rheocyte {

namespace {

std::vector<std::string> arguments_in_utf8() {
  int count = 0;
  wchar_t** const words = ::CommandLineToArgvW(::GetCommandLineW(), &count);
  std::vector<std::string> arguments;
  for (int i = 0; words && i < count; ++i) arguments.push_back(narrow(words[i]));
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

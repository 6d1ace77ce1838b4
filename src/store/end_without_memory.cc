#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <new>

#include "store/process_limits.h"
#include "store/process_limits_of_system.h"

namespace rheocyte {

namespace {

int code_without_memory = 1;

}  // namespace

void end_now() {
  std::array<char, 300> sentence{};  // not a string, which takes memory
  const auto written = fmt::format_to_n(sentence.data(), sentence.size(),
                                        "rheocyte: the memory does not suffice (of {}); a larger numerics.accuracy "
                                        "needs less. What was finished is kept.\n",
                                        whose_memory);
  static_cast<void>(!::write(STDERR_FILENO, sentence.data(), static_cast<std::size_t>(written.out - sentence.data())));
  ::_exit(code_without_memory);
}

void end_without_memory(int exit_code) {
  code_without_memory = exit_code;
  std::set_new_handler(end_now);
}

}  // namespace rheocyte

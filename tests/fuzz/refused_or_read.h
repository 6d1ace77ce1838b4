// What every reader promises of any bytes: it reads them, or throws a UserError with one sentence.
#pragma once
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "case/user_error.h"

namespace rheocyte::test {

/// Any other exception ends the process, which the fuzzer reports.
template <class Read>
int refused_or_read(const std::uint8_t* data, std::size_t size, Read&& read) {
  try {
    read(std::string_view(reinterpret_cast<const char*>(data), size));
  } catch (const UserError& refusal) {
    const std::string_view sentence = refusal.what();
    if (sentence.empty() || sentence.find('\n') != std::string_view::npos) std::abort();
  }
  return 0;
}

}  // namespace rheocyte::test

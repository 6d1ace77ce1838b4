// Any case file is read or refused; what is read can be written and read again to the same text.
#include <cstdlib>

#include "case/read_case.h"
#include "case/write_case.h"
#include "refused_or_read.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return rheocyte::test::refused_or_read(data, size, [](std::string_view text) {
    const auto written = rheocyte::to_toml(rheocyte::parse_case(text, "case.toml"));
    if (rheocyte::to_toml(rheocyte::parse_case(written, "copy.toml")) != written) std::abort();
  });
}

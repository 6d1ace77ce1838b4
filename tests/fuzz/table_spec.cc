// Any spec of a table is read or refused; what is read can be written and read again to the same text.
#include "table/table_spec.h"

#include <cstdlib>

#include "refused_or_read.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return rheocyte::test::refused_or_read(data, size, [](std::string_view text) {
    const auto written = to_toml(rheocyte::parse_table_spec(text, "spec.toml"));
    if (to_toml(rheocyte::parse_table_spec(written, "copy.toml")) != written) std::abort();
  });
}

// Any table in dclab's format is read or refused; what is read can be written and read again.
#include "table/table_text.h"

#include "refused_or_read.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return rheocyte::test::refused_or_read(data, size, [](std::string_view text) {
    const auto table = rheocyte::parse_table_text(text, "table.txt");
    rheocyte::parse_table_text(to_text(table), "copy.txt");
  });
}

// Any table of events as text is read or refused; all columns that are read have one length.
#include "measurement/text_table.h"

#include "refused_or_read.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return rheocyte::test::refused_or_read(data, size, [](std::string_view text) {
    const auto table = rheocyte::parse_text_table(text, "cells.csv");
    for (const auto& column : table.columns)
      if (column.values.size() != table.columns.front().values.size()) std::abort();
  });
}

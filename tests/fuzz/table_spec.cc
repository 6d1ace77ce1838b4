// Any spec of a table, dynamic or not, is read or refused; what is read can be written and read again to the same text.
#include "table/table_spec.h"

#include <cstdlib>

#include "refused_or_read.h"
#include "table/dynamic_spec.h"

namespace {

template <class Spec>
void read_twice(std::string_view text,
                Spec (*parse)(std::string_view, const std::string&, std::span<const std::string>)) {
  const auto written = to_toml(parse(text, "spec.toml", {}));
  if (to_toml(parse(written, "copy.toml", {})) != written) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using rheocyte::test::refused_or_read;
  refused_or_read(data, size, [](std::string_view text) { read_twice(text, rheocyte::parse_table_spec); });
  return refused_or_read(data, size, [](std::string_view text) { read_twice(text, rheocyte::parse_dynamic_spec); });
}

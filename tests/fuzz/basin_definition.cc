// Any definition of a basin in a recording is read or is none; no JSON breaks the reader.
#include <string>

#include "measurement/basin.h"
#include "refused_or_read.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return rheocyte::test::refused_or_read(data, size, [](std::string_view text) {
    const std::string json(text);
    const auto definition = rheocyte::read_basin_definition(json);
    rheocyte::why_basin_is_not_used(json);
    if (definition) rheocyte::basin_files(*definition, "no-such-folder/recording.rtdc");
  });
}

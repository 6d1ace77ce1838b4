// Any spec of a virtual recording is read or refused.
#include "synth/synth_spec.h"

#include "refused_or_read.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return rheocyte::test::refused_or_read(data, size,
                                         [](std::string_view text) { rheocyte::parse_synth_spec(text, "spec.toml"); });
}

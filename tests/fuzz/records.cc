// Any bytes are a record of a branch or a grid, or refused. No fuzzer guesses a checksum: the bytes are tried as they
// stand, and as the content of a record that has been sealed properly.
#include <array>

#include "refused_or_read.h"
#include "table/branch.h"
#include "table/checked_record.h"
#include "table/stiffness_grid.h"

namespace {

using rheocyte::test::refused_or_read;

constexpr std::string_view spec = "0123456789abcdef";

void read_all(const std::uint8_t* data, std::size_t size) {
  refused_or_read(data, size, [](auto bytes) { rheocyte::branch_from_bytes(bytes, std::string(spec), "branch"); });
  refused_or_read(data, size, [](auto bytes) { rheocyte::grid_from_bytes(bytes, "grid"); });
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  read_all(data, size);
  const auto content = nlohmann::json::from_cbor(data, data + size, true, false);
  if (content.is_discarded()) return 0;
  for (const std::string_view kind : {"rheocyte branch", "rheocyte grid"}) {
    const auto sealed = rheocyte::sealed_record({kind, "1", "", ""}, std::string(spec), content);
    read_all(reinterpret_cast<const std::uint8_t*>(sealed.data()), sealed.size());
  }
  return 0;
}

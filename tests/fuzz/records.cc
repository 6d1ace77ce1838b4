// Any bytes are a record of a branch, a grid, elongated cells, a cell's way a combined or a dynamic table, or refused.
// No fuzzer guesses a checksum: the bytes are tried as they stand, and as the content of a record that has been sealed
// properly.
#include <array>

#include "case/json_guard.h"
#include "refused_or_read.h"
#include "table/branch.h"
#include "table/checked_record.h"
#include "table/combined_table.h"
#include "table/dynamic_table.h"
#include "table/elongated_table.h"
#include "table/stiffness_grid.h"

namespace {

using rheocyte::test::refused_or_read;

const std::string spec = "0123456789abcdef";

void read_all(const std::uint8_t* data, std::size_t size) {
  refused_or_read(data, size, [](auto bytes) { rheocyte::branch_from_bytes(bytes, spec, "branch"); });
  refused_or_read(data, size, [](auto bytes) { rheocyte::grid_from_bytes(bytes, "grid"); });
  refused_or_read(data, size, [](auto bytes) {
    const rheocyte::ElongatedTable table(rheocyte::elongated_from_bytes(bytes, "elongated cells"));
    table.at(table.greatest());
  });
  refused_or_read(data, size, [](auto bytes) { rheocyte::course_from_bytes(bytes, spec, {6, 5, 0.5}, "course"); });
  refused_or_read(data, size, [](auto bytes) { rheocyte::combined_from_bytes(bytes, "combined"); });
  refused_or_read(data, size, [](auto bytes) { rheocyte::dynamic_from_bytes(bytes, "dynamic"); });
}

/// Kind and format of the records, as they are written now.
constexpr std::array<std::array<std::string_view, 2>, 6> kinds{{{"rheocyte branch", "2"},
                                                                {"rheocyte grid", "2"},
                                                                {"rheocyte elongated cells", "1"},
                                                                {"rheocyte combined cells", "1"},
                                                                {"rheocyte course", "1"},
                                                                {"rheocyte dynamic table", "1"}}};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  read_all(data, size);
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  if (!rheocyte::is_sound_json(bytes, nlohmann::json::input_format_t::cbor)) return 0;
  const auto content = nlohmann::json::from_cbor(bytes.begin(), bytes.end());
  for (const auto& [kind, format] : kinds) {
    const auto sealed = rheocyte::sealed_record({kind, format, "", ""}, spec, content);
    read_all(reinterpret_cast<const std::uint8_t*>(sealed.data()), sealed.size());
  }
  return 0;
}

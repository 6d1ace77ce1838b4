// Any bytes are a mask, a contour or features, of any size: cells have numbers or states, and nothing reads beyond
// them.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <vector>

#include "instrument/rheocyte_cell.h"
#include "store/build_info.h"

namespace {

constexpr std::uint32_t most_width = 96, most_height = 64;

/// With the set-up that it uses, both as long as the program.
struct Handles {
  rheocyte_cell_setup* set_up = nullptr;
  rheocyte_cell_worker* worker = nullptr;
};

Handles opened() {
  rheocyte_cell_settings settings;
  rheocyte_cell_default_settings(&settings);
  settings.tables_folder = rheocyte::data_folder;
  settings.viscosity_mPas = 8;
  settings.channel_width_um = 20;
  settings.flow_rate_ul_s = 0.04;
  settings.pixel_size_um = 0.34;
  settings.axial_tension_Pa = 200;
  Handles handles;
  if (rheocyte_cell_open(RHEOCYTE_CELL_ABI, &settings, &handles.set_up, nullptr, 0) != 0 ||
      rheocyte_cell_open_worker(handles.set_up, most_width, most_height, 20, &handles.worker) != 0)
    std::abort();
  return handles;
}

/// Takes numbers from the front of the bytes.
struct Bytes {
  const std::uint8_t* data;
  std::size_t size;

  template <class Number>
  Number next() {
    Number number{};
    const std::size_t count = std::min(size, sizeof number);
    if (count > 0) std::memcpy(&number, data, count);
    data += count, size -= count;
    return number;
  }
};

/// The rest of the bytes, in memory of its own, so that whatever reads beyond its end is found.
template <class Number>
std::vector<Number> rest(const Bytes& bytes) {
  std::vector<Number> numbers(bytes.size / sizeof(Number));
  if (!numbers.empty()) std::memcpy(numbers.data(), bytes.data, numbers.size() * sizeof(Number));
  return numbers;
}

void check(std::int32_t status, const rheocyte_cell_result& cell) {
  if (status != RHEOCYTE_CELL_OK) return;
  const auto has = [](int state) {
    return state == RHEOCYTE_CELL_VALID || state == RHEOCYTE_CELL_REGULARISED || state == RHEOCYTE_CELL_INERTIAL;
  };
  if (has(cell.young_state) != std::isfinite(cell.young_modulus_kPa) ||
      has(cell.effective_state) != std::isfinite(cell.effective_modulus_kPa) ||
      (has(cell.young_state) && !(cell.young_modulus_kPa > 0 && cell.young_modulus_error_kPa >= 0)))
    std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const Handles handles = opened();
  rheocyte_cell_worker* const worker = handles.worker;
  Bytes bytes{data, size};
  rheocyte_cell_result cell{};
  const auto kind = bytes.next<std::uint8_t>();
  const std::uint32_t width = bytes.next<std::uint8_t>(), height = bytes.next<std::uint8_t>();
  if (kind % 4 < 2) {  // masks of bytes or bits
    const auto pixels = rest<std::uint8_t>(bytes);
    const std::size_t row = kind % 4 == RHEOCYTE_CELL_BITS ? (width + 7) / 8 : width;
    if (pixels.empty() || pixels.size() < row * height) return 0;  // what no caller may do
    const rheocyte_cell_masks mask{pixels.data(), width, height, kind % 4U, 0, 0, 0};
    check(rheocyte_cell_from_masks(worker, &mask, 1, &cell), cell);
  } else if (kind % 4 == 2) {
    auto xy = rest<std::int32_t>(bytes);
    if (kind & 4)
      for (auto& number : xy) number &= 63;
    check(rheocyte_cell_from_contour(worker, xy.data(), xy.size() / 2, width, height, &cell), cell);
  } else {
    const auto area = bytes.next<double>(), deformation = bytes.next<double>(), ratio = bytes.next<double>();
    check(rheocyte_cell_from_features(worker, &area, &deformation, &ratio, 1, &cell), cell);
  }
  return 0;
}

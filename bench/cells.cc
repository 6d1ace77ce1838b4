// Processor time per cell through the C interface on one core, and of opening (docs/instrument.md).
//
//     bench_cells RECORDING [TENSION_PA [CELLS]]
//
// RECORDING has masks: its own medium, temperature, channel, flow and pixels count. CELLS: 40000 if it is not given.
#include <time.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "case/user_error.h"
#include "measured_masks.h"
#include "program.h"

namespace rheocyte {
namespace {

/// Of this thread, or (kernels without that clock) of the process.
double processor_us() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return 1e6 * double(now.tv_sec) + 1e-3 * double(now.tv_nsec);
}

double quantile_of(std::vector<double> sorted, double fraction) {
  std::ranges::sort(sorted);
  return sorted[std::size_t(fraction * double(sorted.size() - 1))];
}

void print(const char* what, const std::vector<double>& us) {
  double sum = 0;
  for (const double time : us) sum += time;
  std::printf("%-44s median %8.2f us, 99.9 %% %8.2f us, mean %8.2f us (%.0f a second)\n", what, quantile_of(us, 0.5),
              quantile_of(us, 0.999), sum / double(us.size()), 1e6 * double(us.size()) / sum);
}

/// Times of `work(i)` for all cells.
template <class Work>
std::vector<double> times(std::size_t cells, const Work& work) {
  std::vector<double> us(cells);
  for (std::size_t i = 0; i < cells; ++i) {
    const double start = processor_us();
    work(i);
    us[i] = processor_us() - start;
  }
  return us;
}

void check(std::int32_t status) {
  if (status != RHEOCYTE_CELL_OK) throw UserError(rheocyte_cell_status_text(status));
}

void measure_openings(const MeasuredMasks& masks) {
  constexpr int openings = 9;
  const auto us = times(openings, [&](std::size_t) { check(rheocyte_cell_close(masks.open())); });
  print("opening a set-up, tension given", us);
  auto without = masks;
  without.settings.axial_tension_Pa = NAN;
  print("opening a set-up, tension unknown",
        times(openings, [&](std::size_t) { check(rheocyte_cell_close(without.open())); }));
}

void measure_cells(const MeasuredMasks& masks, rheocyte_cell_setup* set_up, std::size_t cells) {
  rheocyte_cell_worker* worker = nullptr;
  check(rheocyte_cell_open_worker(set_up, masks.width(), masks.height(), 0, &worker));
  std::vector<rheocyte_cell_result> results(cells);
  const auto of_mask = [&](std::size_t i) {
    check(rheocyte_cell_from_mask(worker, masks.mask(i), masks.width(), masks.height(), 0, &results[i]));
  };
  times(cells, of_mask);  // once, so that the memory is there
  print("clock alone", times(cells, [](std::size_t) {}));
  print("mask -> E, S with errors", times(cells, of_mask));
  const auto of_features = [&](std::size_t i) {
    rheocyte_cell_result result;
    check(rheocyte_cell_from_features(worker, &results[i].area_um2, &results[i].deformation, &results[i].inertia_ratio,
                                      1, &result));
  };
  print("features -> E, S with errors", times(cells, of_features));
  std::vector<double> area, deformation, ratio;
  for (const auto& cell : results) {
    area.push_back(cell.area_um2);
    deformation.push_back(cell.deformation);
    ratio.push_back(cell.inertia_ratio);
  }
  constexpr int rounds = 20;
  auto batches = times(rounds, [&](std::size_t) {
    check(rheocyte_cell_from_features(worker, area.data(), deformation.data(), ratio.data(), cells, results.data()));
  });
  for (double& us : batches) us /= double(cells);
  print("features -> E, S with errors, in one call", batches);
  rheocyte_cell_counts counts{};
  check(rheocyte_cell_get_counts(worker, &counts));
  std::printf("of %llu cells %llu have E, %llu have S\n", static_cast<unsigned long long>(counts.cells),
              static_cast<unsigned long long>(counts.young[0]), static_cast<unsigned long long>(counts.effective[0]));
  rheocyte_cell_setup* refreshed = nullptr;
  std::array<char, 500> message{};
  const auto us = times(
      1, [&](std::size_t) { rheocyte_cell_refresh(set_up, &worker, 1, &refreshed, message.data(), message.size()); });
  rheocyte_cell_tension tension{};
  if (refreshed) {
    check(rheocyte_cell_get_tension(refreshed, &tension));
    std::printf("refresh: %.0f ms, %.4g +- %.2g +- %.2g Pa from %llu cells\n", us.front() / 1e3, tension.value_Pa,
                tension.error_Pa, tension.common_error_Pa, static_cast<unsigned long long>(tension.cells));
    check(rheocyte_cell_close(refreshed));
  } else {
    std::printf("refresh: %.0f ms: %s\n", us.front() / 1e3, message.data());
  }
  check(rheocyte_cell_close_worker(worker));
}

}  // namespace

int measure(int argc, char** argv) {
  if (argc < 2) throw UserError("bench_cells RECORDING [TENSION_PA [CELLS]]");
  MeasuredMasks masks = read_masks(argv[1]);
  masks.settings.axial_tension_Pa = argc > 2 ? std::atof(argv[2]) : 200;
  const std::size_t cells = argc > 3 ? std::size_t(std::atol(argv[3])) : 40000;
  measure_openings(masks);
  rheocyte_cell_setup* const set_up = masks.open();
  measure_cells(masks, set_up, cells);
  check(rheocyte_cell_close(set_up));
  return 0;
}

}  // namespace rheocyte

// Feeds the masks of a recording to the C interface at the pace at which they were recorded, and prints how long after
// its picture each cell was decided: time on the clock, with all that the system does in between.
//
//     replay_cells RECORDING [TENSION_PA [PACE]]
//
// PACE 2: twice as fast as recorded; 0: one after the other. The recording has the feature `time` (s).
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <thread>
#include <vector>

#include "measured_masks.h"
#include "program.h"

namespace rheocyte {
namespace {

using Clock = std::chrono::steady_clock;

std::vector<double> times_of(const std::filesystem::path& file, std::size_t events) {
  const Recording recording(file);
  std::vector<double> seconds(events);
  if (!recording.has_scalar("time")) throw UserError(file.string() + ": has no feature time.");
  recording.read_scalar("time", 0, seconds);
  const double first = seconds.front();
  for (double& time : seconds) time -= first;
  return seconds;
}

}  // namespace

int measure(int argc, char** argv) {
  if (argc < 2) throw UserError("replay_cells RECORDING [TENSION_PA [PACE]]");
  MeasuredMasks masks = read_masks(argv[1]);
  if (argc > 2) masks.settings.axial_tension_Pa = std::atof(argv[2]);
  const double pace = argc > 3 ? std::atof(argv[3]) : 1;
  const auto seconds = times_of(argv[1], masks.count);
  rheocyte_cell_setup* const set_up = masks.open();
  rheocyte_cell_worker* worker = nullptr;
  if (rheocyte_cell_open_worker(set_up, masks.width(), masks.height(), 0, &worker) != RHEOCYTE_CELL_OK) return 2;
  std::vector<double> latency_us;
  const auto start = Clock::now();
  for (std::size_t i = 0; i < masks.count; ++i) {
    auto due = Clock::now();
    if (pace > 0) {
      due = start + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds[i] / pace));
      std::this_thread::sleep_until(due);
    }
    rheocyte_cell_result result;
    rheocyte_cell_from_mask(worker, masks.mask(i), masks.width(), masks.height(), 0, &result);
    latency_us.push_back(std::chrono::duration<double, std::micro>(Clock::now() - due).count());
  }
  std::ranges::sort(latency_us);
  const auto at = [&](double fraction) { return latency_us[std::size_t(fraction * double(latency_us.size() - 1))]; };
  std::printf("%zu cells in %.3g s: median %.1f us, 99 %% %.1f us, 99.9 %% %.1f us, longest %.1f us\n", masks.count,
              seconds.back(), at(0.5), at(0.99), at(0.999), at(1));
  rheocyte_cell_close_worker(worker);
  rheocyte_cell_close(set_up);
  return 0;
}

}  // namespace rheocyte

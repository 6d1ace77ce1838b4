// How well moduli of virtual cells come back: round_trip COMPANION...
//
// COMPANION: what `rheocyte extract` wrote for a recording of `rheocyte synth`. The true moduli are in the recording
// itself (userdef2), to which the companion leads.
#include <fmt/format.h>

#include <cmath>
#include <vector>

#include "columns.h"
#include "numeric/quantile.h"
#include "program.h"

namespace {

using namespace rheocyte;

void report(const char* file) {
  const Recording recording(file);
  const auto feature_of_error = recording.metadata().text("user:rheocyte young_modulus_kPa_error");
  const auto modulus = column(recording, "emodulus"), error = column(recording, feature_of_error.value_or("").c_str()),
             truth = column(recording, "userdef2"), deformation = column(recording, "userdef4");
  std::vector<double> bias, fraction, depth;
  int covered = 0, within = 0;
  for (std::size_t i = 0; i < modulus.size(); ++i) {
    if (!std::isfinite(modulus[i])) continue;
    bias.push_back(100 * (modulus[i] / truth[i] - 1));
    fraction.push_back(100 * error[i] / modulus[i]);
    depth.push_back(deformation[i]);
    covered += std::abs(modulus[i] - truth[i]) < 1.6449 * error[i];
    within += std::abs(modulus[i] - truth[i]) < error[i];
  }
  const double n = static_cast<double>(bias.size());
  fmt::print(
      "{}: {} of {} cells, deformation {:.4f} ({:.4f} to {:.4f}), bias {:+.2f} % (5 to 95 %: {:+.1f} to {:+.1f}), "
      "standard "
      "error {:.1f} %, in the 90 % interval {:.1f} %, in the 68 % interval {:.1f} %\n",
      file, bias.size(), modulus.size(), quantile(depth, 0.5), quantile(depth, 0.05), quantile(depth, 0.95),
      quantile(bias, 0.5), quantile(bias, 0.05), quantile(bias, 0.95), quantile(fraction, 0.5), 100 * covered / n,
      100 * within / n);
}

}  // namespace

int rheocyte::measure(int argc, char** argv) {
  if (argc < 2) return fmt::print("round_trip COMPANION...\n"), 2;
  for (int i = 1; i < argc; ++i) report(argv[i]);
  return 0;
}

// What nodes and bins change: population_nodes RECORDINGS...
//
// Each recording is fitted as `rheocyte population` does it, with 24 nodes for each event and, of more than 20,000, in
// bins; and with 48 nodes and without bins. Printed are the differences in standard errors, and the seconds of both.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "experiment/population_sample.h"
#include "population/fit_cells.h"
#include "program.h"

namespace {

using namespace rheocyte;

struct Timed {
  FittedCells fitted;
  std::size_t bins;
  double seconds;
};

Timed fitted_with(const PopulationEvents& events, PopulationMaps& maps, int nodes, bool no_bins) {
  const auto start = std::chrono::steady_clock::now();
  const PopulationSample made = population_sample(events, maps, {no_bins});
  FitSettings settings;
  settings.threads = 2;
  settings.nodes = nodes;
  FittedCells fitted = fit_cells(made.sample, settings);
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
  return {std::move(fitted), made.sample.bins(), took.count()};
}

}  // namespace

int rheocyte::measure(int argc, char** argv) {
  constexpr int exact_nodes = 48;
  double greatest = 0;
  PopulationMaps maps(StiffnessMeasure::asymmetry);
  for (int k = 1; k < argc; ++k) {
    const PopulationEvents events =
        read_population_events(argv[k], MeasuringOptions(), StiffnessMeasure::asymmetry, [](double) {});
    const Timed usual = fitted_with(events, maps, usual_nodes, false),
                exact = fitted_with(events, maps, exact_nodes, true);
    fmt::print("{}: {} events, {} bins in {:.1f} s, exactly in {:.1f} s; differences in standard errors", argv[k],
               events.events(), usual.bins, usual.seconds, exact.seconds);
    for (int p = 0; p < population_parameters; ++p) {
      const double off = (usual.fitted.cells.parameters()(p) - exact.fitted.cells.parameters()(p)) /
                         exact.fitted.standard_error(PopulationParameter(p));
      greatest = std::max(greatest, std::abs(off));
      fmt::print(" {:+.4f}", off);
    }
    fmt::print("\n");
  }
  fmt::print("greatest: {:.4f} standard errors\n", greatest);
  return greatest < 0.1 ? 0 : 1;
}

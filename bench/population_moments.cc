// How well the law of cells with bulk, cortex and tensions comes back from virtual recordings: population_moments TABLE
// [--recordings 40] [--cells 500] [--young 2] [--cortex 10] [--viscosity 15] [--tension 0.3]
//
// TABLE: combined_*.cbor. Cells of 6.5 um: E (kPa), E2D (mN/m) lognormal with a spread of 20 %, r0 of 7 %, tension over
// E2D of 0.3 with 30 %; the axial tension, over the wall's shear stress, is the same for all. Each is seen once in
// pixels of 0.34 um, as an outline whose hull has the modes of the table.
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <map>
#include <string>
#include <variant>
#include <vector>

#include "infer/combined_population.h"
#include "measurement/shape_in_pixels.h"
#include "program.h"
#include "synth/combined_shapes.h"
#include "synth/outline.h"

namespace {

using namespace rheocyte;

constexpr double pixel_um = 0.34;

struct Wanted {
  int recordings = 40, cells = 500;
  double young = 2, cortex = 10, viscosity = 15, tension = 0.3;
};

/// Of one recording: the means of the numbers of the cells that were seen.
struct Truth {
  double stiffness = 0, young = 0, cortex = 0, ratio = 0;
};

class Recordings {
 public:
  explicit Recordings(const char* file, const Wanted& wanted)
      : table_(read_combined_table(file)),
        between_(table_),
        simulated_(channel_flow_of(table_.spec.base)),
        moduli_(between_, simulated_, {features_of_contour(7), true, 0}),
        flow_{20, 0.04, wanted.viscosity, simulated_.exponent},
        shapes_(table_, {simulated_, flow_}),
        wanted_(wanted) {}

  std::vector<MeasuredCell> seen(std::uint64_t seed, Truth& truth) const {
    std::vector<MeasuredCell> cells;
    for (std::uint64_t number = 0; int(cells.size()) < wanted_.cells; ++number) {
      CellRandom random(seed, number, Purpose::population);
      VirtualCell cell;
      cell.radius_um = 6.5 * std::exp(0.07 * random.normal());
      cell.stiffness = wanted_.young * std::exp(0.2 * random.normal());
      cell.cortex_modulus_mN_per_m = wanted_.cortex * std::exp(0.2 * random.normal());
      const double ratio = 0.3 * (1 + 0.3 * random.normal());
      cell.tension_mN_per_m = ratio * cell.cortex_modulus_mN_per_m;
      cell.viscosity_mPas = flow_.viscosity_mPas;
      cell.axial_tension_Pa = wanted_.tension * wall_shear_stress_Pa(flow_);
      const auto shape = shapes_.shape(cell);
      if (!std::holds_alternative<CellShape>(shape)) continue;
      const double along = random.uniform() - 0.5, across = random.uniform() - 0.5;
      cells.push_back(
          {features_in_pixels(silhouette(std::get<CellShape>(shape).meridian), pixel_um, {along, across}), flow_});
      const double n = wanted_.cells;
      truth.stiffness += std::log(cell.stiffness + cell.cortex_modulus_mN_per_m / cell.radius_um) / n;
      truth.young += std::log(cell.stiffness) / n;
      truth.cortex += std::log(cell.cortex_modulus_mN_per_m) / n;
      truth.ratio += ratio / n;
    }
    return cells;
  }

  CombinedPopulation found(const std::vector<MeasuredCell>& cells) const {
    return fit_combined_population(moduli_, {flow_, Section::tube, 1}, pixel_um, cells, [] {});
  }

 private:
  CombinedTable table_;
  CombinedInterpolation between_;
  ChannelFlow simulated_;
  BulkCortexFit moduli_;
  ChannelFlow flow_;
  CombinedShapes shapes_;
  Wanted wanted_;
};

/// Of one number in many recordings.
struct Tally {
  std::vector<double> off, error;

  void take(double value, double truth, double standard_error) {
    off.push_back(value - truth);
    error.push_back(standard_error);
  }
  void print(const std::string& name) const {
    const auto n = double(off.size());
    double mean = 0, squares = 0, stated = 0;
    int inside = 0;
    for (std::size_t i = 0; i < off.size(); ++i) {
      mean += off[i] / n;
      stated += error[i] / n;
      inside += std::abs(off[i]) < 1.6449 * error[i];
    }
    for (const double x : off) squares += (x - mean) * (x - mean) / (n - 1);
    fmt::print("  {:14}: bias {:+.4f} +- {:.4f}; scatter {:.4f}, stated {:.4f}; 90 % intervals hold {:.0f} %\n", name,
               mean, std::sqrt(squares / n), std::sqrt(squares), stated, 100 * inside / n);
  }
};

Wanted wanted_by(int argc, char** argv) {
  Wanted wanted;
  for (int i = 2; i + 1 < argc; i += 2) {
    const std::string name = argv[i];
    const double value = std::stod(argv[i + 1]);
    if (name == "--recordings") wanted.recordings = int(value);
    if (name == "--cells") wanted.cells = int(value);
    if (name == "--young") wanted.young = value;
    if (name == "--cortex") wanted.cortex = value;
    if (name == "--viscosity") wanted.viscosity = value;
    if (name == "--tension") wanted.tension = value;
  }
  return wanted;
}

/// Standard error of a mean of logarithms, with what the table leaves of all events alike.
double error_of(const CombinedPopulation& found, double CombinedLogs::*log) {
  const CombinedVector slopes = slopes_of_mean(found.fit.parameters, log);
  return std::sqrt(slopes.dot((found.fit.covariance + found.common_covariance) * slopes));
}

}  // namespace

int rheocyte::measure(int argc, char** argv) {
  if (argc < 2) return fmt::print("population_moments TABLE [--recordings 40] [--cells 500] ...\n"), 2;
  const Wanted wanted = wanted_by(argc, argv);
  const Recordings recordings(argv[1], wanted);
  std::map<std::string, Tally> tallies;
  for (int seed = 1; seed <= wanted.recordings; ++seed) {
    Truth truth;
    const auto cells = recordings.seen(std::uint64_t(seed), truth);
    const CombinedPopulation found = recordings.found(cells);
    if (!found.fit.is_found) {
      fmt::print("recording {}: nothing found\n", seed);
      continue;
    }
    const CombinedLogs logs = log_means(found.law);
    constexpr int ratio = int(CombinedParameter::tension_ratio);
    tallies["ln E"].take(logs.young, truth.young, error_of(found, &CombinedLogs::young));
    tallies["ln E2D"].take(logs.cortex, truth.cortex, error_of(found, &CombinedLogs::cortex));
    tallies["ln S"].take(logs.stiffness, truth.stiffness, error_of(found, &CombinedLogs::stiffness));
    tallies["ln T"].take(logs.axial, std::log(wanted.tension), error_of(found, &CombinedLogs::axial));
    tallies["tension ratio"].take(
        found.law.tension_ratio, truth.ratio,
        std::sqrt(found.fit.covariance(ratio, ratio) + found.common_covariance(ratio, ratio)));
  }
  for (const auto& [name, tally] : tallies) tally.print(name);
  return 0;
}

// How well the law of cells with bulk, cortex and tensions comes back from virtual recordings: population_moments TABLE
// [--recordings 40] [--cells 500] [--young 2] [--cortex 10] [--viscosity 15] [--tension 0.3] [--radius 6.5]
// [--least-area UM2] [--greatest-area UM2] [--outline-noise UM] [--known-noise UM] [--first-seed 1] [--each 1]
//
// TABLE: combined_*.cbor. Cells of 6.5 um: E (kPa), E2D (mN/m) lognormal with a spread of 20 %, r0 of 7 %, tension over
// E2D of 0.3 with 30 %; the axial tension, over the wall's shear stress, is the same for all. Each is seen once in
// pixels of 0.34 um, as an outline whose hull has the modes of the table. Gates on the measured area keep --cells of
// them; the truth is that of all cells whose shape is in the table. Outlines are off by --outline-noise, and the fit
// takes --known-noise for it. With --each a line for each recording.
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <map>
#include <string>
#include <variant>
#include <vector>

#include "infer/combined_population.h"
#include "measurement/outline_noise.h"
#include "measurement/shape_in_pixels.h"
#include "program.h"
#include "synth/combined_shapes.h"
#include "synth/outline.h"

namespace {

using namespace rheocyte;

constexpr double pixel_um = 0.34;

struct Wanted {
  int recordings = 40, cells = 500;
  double young = 2, cortex = 10, viscosity = 15, tension = 0.3, radius = 6.5;
  double least_area = 0, greatest_area = HUGE_VAL, outline_noise = 0, known_noise = 0;
  int first_seed = 1;
  bool each = false;
};

/// Of one recording: the means of the numbers of its cells, also of those that gates leave out.
struct Truth {
  double stiffness = 0, effective = 0, young = 0, cortex = 0, ratio = 0;
  int cells = 0, without_shape = 0;

  void add(const VirtualCell& cell, const CellsAtRest& at_rest) {
    const double S = cell.stiffness + cell.cortex_modulus_mN_per_m / cell.radius_um;
    effective += std::log(S * effective_modulus_over_stiffness<double>(
                                  at_rest, {std::log(cell.radius_um), std::log(S), 1 - cell.stiffness / S,
                                            cell.tension_mN_per_m / cell.cortex_modulus_mN_per_m}));
    stiffness += std::log(S);
    young += std::log(cell.stiffness);
    cortex += std::log(cell.cortex_modulus_mN_per_m);
    ratio += cell.tension_mN_per_m / cell.cortex_modulus_mN_per_m;
    ++cells;
  }
  void divide() {
    for (double* const sum : {&stiffness, &effective, &young, &cortex, &ratio}) *sum /= cells;
  }
};

class Recordings {
 public:
  explicit Recordings(const char* file, const Wanted& wanted)
      : table_(read_combined_table(file)),
        between_(table_),
        simulated_(channel_flow_of(table_.spec.base)),
        moduli_(between_, simulated_, {features_of_contour(7), true, 0}),
        flow_{20, 0.04, wanted.viscosity, simulated_.exponent},
        at_rest_(moduli_.at_rest().scaled(scale_factors(simulated_, flow_))),
        shapes_(table_, {simulated_, flow_}),
        log_area_{std::log(wanted.least_area), std::log(wanted.greatest_area)},
        wanted_(wanted) {}

  std::vector<MeasuredCell> seen(std::uint64_t seed, Truth& truth) const {
    std::vector<MeasuredCell> cells;
    for (std::uint64_t number = 0; int(cells.size()) < wanted_.cells; ++number) {
      CellRandom random(seed, number, Purpose::population);
      const VirtualCell cell = drawn(random);
      const auto shape = shapes_.shape(cell);
      if (!std::holds_alternative<CellShape>(shape)) {
        ++truth.without_shape;
        continue;
      }
      truth.add(cell, at_rest_);
      const double along = random.uniform() - 0.5, across = random.uniform() - 0.5;
      const auto outline =
          displaced(silhouette(std::get<CellShape>(shape).meridian), {.deviation = wanted_.outline_noise}, random);
      const ShapeVector features = features_in_pixels(outline, pixel_um, {along, across});
      if (log_area_.pass(features(int(ShapeFeature::area_um2)))) cells.push_back({features, flow_});
    }
    truth.divide();
    return cells;
  }

  CombinedPopulation found(const std::vector<MeasuredCell>& cells) const {
    const SeenPopulation seen{.sight = {flow_, Section::tube, 1},
                              .pixel_size_um = pixel_um,
                              .log_area = log_area_,
                              .outline_noise = {.deviation = wanted_.known_noise}};
    return fit_combined_population(moduli_, seen, cells, {});
  }

 private:
  VirtualCell drawn(CellRandom& random) const {
    VirtualCell cell;
    cell.radius_um = wanted_.radius * std::exp(0.07 * random.normal());
    cell.stiffness = wanted_.young * std::exp(0.2 * random.normal());
    cell.cortex_modulus_mN_per_m = wanted_.cortex * std::exp(0.2 * random.normal());
    cell.tension_mN_per_m = 0.3 * (1 + 0.3 * random.normal()) * cell.cortex_modulus_mN_per_m;
    cell.viscosity_mPas = flow_.viscosity_mPas;
    cell.axial_tension_Pa = wanted_.tension * wall_shear_stress_Pa(flow_);
    return cell;
  }

  CombinedTable table_;
  CombinedInterpolation between_;
  ChannelFlow simulated_;
  BulkCortexFit moduli_;
  ChannelFlow flow_;
  CellsAtRest at_rest_;
  CombinedShapes shapes_;
  ValueGate log_area_;
  Wanted wanted_;
};

/// Of one number in a recording.
struct Told {
  std::string name;
  double value, truth, standard_error;
};

/// In many recordings.
struct Tally {
  std::vector<double> off, error;

  void take(const Told& told) {
    off.push_back(told.value - told.truth);
    error.push_back(told.standard_error);
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
  double recordings = wanted.recordings, cells = wanted.cells, first_seed = wanted.first_seed, each = 0;
  const std::map<std::string, double*> options{{"--recordings", &recordings},
                                               {"--cells", &cells},
                                               {"--young", &wanted.young},
                                               {"--cortex", &wanted.cortex},
                                               {"--viscosity", &wanted.viscosity},
                                               {"--tension", &wanted.tension},
                                               {"--radius", &wanted.radius},
                                               {"--least-area", &wanted.least_area},
                                               {"--greatest-area", &wanted.greatest_area},
                                               {"--outline-noise", &wanted.outline_noise},
                                               {"--known-noise", &wanted.known_noise},
                                               {"--first-seed", &first_seed},
                                               {"--each", &each}};
  for (int i = 2; i + 1 < argc; i += 2)
    if (const auto found = options.find(argv[i]); found != options.end()) *found->second = std::stod(argv[i + 1]);
  wanted.recordings = int(recordings), wanted.cells = int(cells), wanted.first_seed = int(first_seed);
  wanted.each = each > 0;
  return wanted;
}

/// Standard error of a mean of logarithms, with what the table leaves of all events alike.
double error_of(const CombinedPopulation& found, double CombinedLogs::*log) {
  return number_of_law(found, log).error();
}

void print(int seed, const CombinedPopulation& found, const std::vector<Told>& all) {
  fmt::print("{:3}", seed);
  for (const Told& told : all)
    fmt::print(" {:+.4f}({:+.1f})", told.value - told.truth, (told.value - told.truth) / told.standard_error);
  fmt::print(" kept {:.2f}", found.kept_fraction);
  for (int a = 0; a < combined_parameters; ++a)
    fmt::print(" {:.3f}{}", found.fit.parameters(a), found.fit.at_bound[std::size_t(a)] ? "!" : "");
  fmt::print("\n");
}

}  // namespace

int rheocyte::measure(int argc, char** argv) {
  if (argc < 2) return fmt::print("population_moments TABLE [--recordings 40] [--cells 500] ...\n"), 2;
  const Wanted wanted = wanted_by(argc, argv);
  const Recordings recordings(argv[1], wanted);
  std::map<std::string, Tally> tallies;
  double kept = 0, without_shape = 0;
  for (int seed = wanted.first_seed; seed < wanted.first_seed + wanted.recordings; ++seed) {
    Truth truth;
    const auto cells = recordings.seen(std::uint64_t(seed), truth);
    const CombinedPopulation found = recordings.found(cells);
    kept += double(cells.size()) / truth.cells / wanted.recordings;
    without_shape += double(truth.without_shape) / (truth.cells + truth.without_shape) / wanted.recordings;
    if (!found.fit.is_found) {
      fmt::print("recording {}: nothing found\n", seed);
      continue;
    }
    const CombinedLogs logs = log_means(found.law, found.at_rest);
    constexpr int ratio = int(CombinedParameter::tension_ratio);
    const std::vector<Told> all{
        {"ln E", logs.young, truth.young, error_of(found, &CombinedLogs::young)},
        {"ln E2D", logs.cortex, truth.cortex, error_of(found, &CombinedLogs::cortex)},
        {"ln E_eff", logs.effective, truth.effective, error_of(found, &CombinedLogs::effective)},
        {"ln S", logs.stiffness, truth.stiffness, error_of(found, &CombinedLogs::stiffness)},
        {"ln T", logs.axial, std::log(wanted.tension), error_of(found, &CombinedLogs::axial)},
        {"tension ratio", found.law.tension_ratio, truth.ratio,
         std::sqrt(found.fit.covariance(ratio, ratio) + found.common_covariance(ratio, ratio))}};
    for (const Told& told : all) tallies[told.name].take(told);
    if (wanted.each) print(seed, found, all);
  }
  fmt::print("gates keep {:.2f}; cells without a shape {:.3f}\n", kept, without_shape);
  for (const auto& [name, tally] : tallies) tally.print(name);
  return 0;
}

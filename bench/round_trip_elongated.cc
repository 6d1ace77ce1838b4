// How well moduli of elongated cells come back: round_trip_elongated FILE [CELLS [PLACES [SEED [COMPUTED MEASURED]]]]
//
// FILE: a table of elongated cells, whose liquid is that of the cells. With COMPUTED and MEASURED, grids of cells
// without elongation in its liquid and in another one, the cells are in that other liquid. Cells of random size,
// stiffness and elongation, by an axial tension or by their shape at rest, are solved in the square channel, drawn into
// masks of pixels at random places, and estimated by modes and by the inertia ratio. None is a node of the table; half
// of them are not even cells of its model.
#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <map>
#include <vector>

#include "case/read_case.h"
#include "case/scales.h"
#include "infer/elongated_liquid.h"
#include "infer/read_modulus_map.h"
#include "measurement/shape_in_pixels.h"
#include "numeric/cell_random.h"
#include "numeric/quantile.h"
#include "program.h"
#include "solve/session.h"
#include "store/read_file.h"
#include "sweep/measured_state.h"

namespace {

using namespace rheocyte;

constexpr double pixel_um = 0.34, viscosity_mPas = 6;

struct Drawn {
  double radius_um, modulus_kPa, elongation;
  bool at_rest;  ///< elongated by the shape at rest, not by a tension
};

/// Of cells as real ones are.
Drawn random_cell(CellRandom& random) {
  const double radius = 5 + 3 * random.uniform(), modulus = std::exp(std::log(4) * random.uniform());
  return {radius, modulus, 1 + 0.5 * random.uniform(), random.uniform() < 0.5};
}

/// T / E of the tension that draws a neo-Hookean sphere out so.
double ratio_of(double aspect) {
  const double stretch = std::pow(aspect, 2.0 / 3);
  return (stretch * stretch - 1 / stretch) / 3;
}

Case case_of(const Drawn& cell, double exponent) {
  const ChannelFlow flow{20, 0.04, viscosity_mPas, exponent};
  return parse_case(fmt::format("channel.section = \"square\"\nchannel.width_um = 20\nflow.rate_ul_per_s = 0.04\n"
                                "flow.law = \"power-law\"\nflow.consistency_Pa_sn = {}\nflow.exponent = "
                                "{}\ncell.radius_um = {}\ncell.bulk.young_modulus_kPa = {}\n"
                                "numerics.accuracy = 1e-3\n{}",
                                consistency_Pa_sn(flow), exponent, cell.radius_um, cell.modulus_kPa,
                                cell.at_rest ? fmt::format("cell.rest_aspect = {}", cell.elongation)
                                             : fmt::format("flow.axial_tension_Pa = {}",
                                                           1e3 * cell.modulus_kPa * ratio_of(cell.elongation))),
                    "case");
}

struct Score {
  std::vector<double> bias;                 ///< medians of the cells, %
  std::vector<double> elongation, tension;  ///< medians of the cells less the truth; tensions over Young's modulus
  int seen = 0, told = 0, covered = 0, within = 0;
};

void take(const ElongatedLiquid& solids, double exponent, ElongatedBy by, const std::vector<ShapeVector>& seen,
          const Drawn& cell, Score& score) {
  const double truth = cell.modulus_kPa;
  const std::size_t n = seen.size();
  std::vector<double> area, deformation, first, second, fourth, fifth, viscosity(n, viscosity_mPas), modulus(n),
      error(n), elongation(n), elongation_error(n), tension(n), tension_error(n), told, elongations, tensions;
  std::vector<ModulusState> states(n);
  std::vector<ElongatedCell> cells(n);
  for (const ShapeVector& v : seen) {
    area.push_back(std::exp(v(0)));
    deformation.push_back(v(1));
    const int mode_2 = int(ShapeFeature::first_mode);
    first.push_back(by == ElongatedBy::modes ? v(mode_2) : 1 / std::sqrt(v(2)));
    second.push_back(by == ElongatedBy::modes ? v(mode_2 + 1) : v(1));
    fourth.push_back(v(mode_2 + 2));
    fifth.push_back(v(mode_2 + 3));
  }
  solids.estimate({{20, 0.04, 0, exponent}, pixel_um}, {area, deformation, viscosity},
                  {by, first, second, fourth, fifth},
                  {{modulus, error, states}, elongation, elongation_error, tension, tension_error, cells});
  for (std::size_t i = 0; i < n; ++i) {
    ++score.seen;
    if (!has_modulus(states[i])) continue;
    ++score.told;
    told.push_back(modulus[i]);
    elongations.push_back(elongation[i]);
    tensions.push_back(tension[i]);
    score.covered += std::abs(modulus[i] - truth) < 1.6449 * error[i];
    score.within += std::abs(modulus[i] - truth) < error[i];
  }
  if (told.size() <= n / 2) return;
  score.bias.push_back(100 * (quantile(told, 0.5) / truth - 1));
  score.elongation.push_back(quantile(elongations, 0.5) - cell.elongation);
  score.tension.push_back(1e-3 * quantile(tensions, 0.5) / truth - ratio_of(cell.elongation));
}

double root_mean_square(const std::vector<double>& values) {
  double squares = 0;
  for (const double value : values) squares += value * value;
  return std::sqrt(squares / double(values.size()));
}

void tell(const char* name, const Score& s) {
  if (s.bias.empty()) return;
  fmt::print(
      "{}: {} cells, bias of the median {:+.2f} % (of cells 5 to 95 %: {:+.1f} to {:+.1f} %), {:.1f} % of images told, "
      "in the 90 % interval {:.1f} %, in the 68 % interval {:.1f} %\n",
      name, s.bias.size(), quantile(s.bias, 0.5), quantile(s.bias, 0.05), quantile(s.bias, 0.95),
      100.0 * s.told / s.seen, 100.0 * s.covered / s.told, 100.0 * s.within / s.told);
  fmt::print(
      "  medians of elongation and of tension / E less the truth: {:+.4f}, {:+.4f}; root mean square {:.4f}, {:.4f}\n",
      quantile(s.elongation, 0.5), quantile(s.tension, 0.5), root_mean_square(s.elongation),
      root_mean_square(s.tension));
}

}  // namespace

int rheocyte::measure(int argc, char** argv) {
  if (argc < 2) return fmt::print("round_trip_elongated FILE [CELLS [PLACES [SEED [COMPUTED MEASURED]]]]\n"), 2;
  const ElongatedSolids solids(elongated_from_bytes(content_of_file(argv[1], largest_elongated), argv[1]));
  std::unique_ptr<const ModulusMap> computed, measured;
  if (argc > 6) computed = read_modulus_map(argv[5]), measured = read_modulus_map(argv[6]);
  const ElongatedLiquid liquid(solids, computed.get(), measured.get());
  const double exponent = (measured ? measured->origin() : solids.origin()).flow.exponent;
  const int count = argc > 2 ? std::atoi(argv[2]) : 40, places = argc > 3 ? std::atoi(argv[3]) : 80;
  CellRandom random(argc > 4 ? std::uint64_t(std::atoi(argv[4])) : 1, 0, Purpose::place);
  std::map<std::string, Score> scores;
  Session session;
  for (int k = 0; k < count;) {
    const Drawn cell = random_cell(random);
    const Case c = case_of(cell, exponent);
    const StationaryState state = session.solve(problem_of(c));
    if (state.outcome.status != Status::converged) continue;
    ++k;
    const Eigen::MatrixX2d outline = mirrored(measure_state(state, scales_of(c)).contour);
    std::vector<ShapeVector> seen;
    for (int place = 0; place < places; ++place)
      seen.push_back(features_in_pixels(outline, pixel_um, {random.uniform() - 0.5, random.uniform() - 0.5}));
    const char* kind = cell.at_rest ? "shape at rest" : "tension";
    take(liquid, exponent, ElongatedBy::modes, seen, cell, scores[fmt::format("modes, {}", kind)]);
    take(liquid, exponent, ElongatedBy::inertia, seen, cell, scores[fmt::format("inertia, {}", kind)]);
  }
  for (const auto& [name, score] : scores) tell(name.c_str(), score);
  return 0;
}

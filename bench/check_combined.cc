// How well moduli come back through a combined table: check_combined TABLE-FOLDER RESULT-FOLDERS...
//
// The results are of `rheocyte solve` in the table's channel. Of each cell the exact contour and pictures of it at
// random positions of 0.34 um pixels give E and E2D, by the measures of figure 9 and by the whole contour.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "infer/pixel_law.h"
#include "program.h"
#include "synth/shape_in_pixels.h"

namespace {

using namespace rheocyte;

constexpr double pixel_um = 0.34;
constexpr int positions = 40;

struct SolvedCell {
  double radius_um, young_kPa, cortex_mN_m;
  Eigen::MatrixX2d outline;
};

SolvedCell read_cell(const std::filesystem::path& folder) {
  const auto result = nlohmann::json::parse(std::ifstream(folder / "result.json"));
  const auto& cell = result.at("case").at("cell");
  std::ifstream file(folder / "contour.csv");
  std::string line;
  std::getline(file, line);
  std::vector<Eigen::RowVector2d> points;
  while (std::getline(file, line)) {
    Eigen::RowVector2d point;
    char comma = 0;
    std::istringstream(line) >> point.x() >> comma >> point.y();
    points.push_back(point);
  }
  Eigen::MatrixX2d meridian(Eigen::Index(points.size()), 2);
  for (Eigen::Index i = 0; i < meridian.rows(); ++i) meridian.row(i) = points[std::size_t(i)];
  return {cell.at("radius_um"), cell.at("bulk").at("young_modulus_kPa"), cell.at("cortex").at("modulus_mN_per_m"),
          mirrored(meridian)};
}

/// Relative errors of E and E2D over many fits, and how many 90 % intervals hold the truth.
struct Tally {
  std::vector<double> young, cortex;
  int fits = 0, resolved = 0, unresolved = 0, other = 0, young_held = 0, cortex_held = 0, beyond = 0;

  void take(const ModuliEstimate& e, const SolvedCell& cell) {
    ++fits;
    resolved += e.status == ModuliStatus::resolved;
    unresolved += e.status == ModuliStatus::not_told_apart;
    other += e.status != ModuliStatus::resolved && e.status != ModuliStatus::not_told_apart;
    const auto miss = [&](Modulus m, double truth) { return e.value(m) - truth; };
    young_held += std::abs(miss(Modulus::young, cell.young_kPa)) < 1.645 * e.error(Modulus::young);
    cortex_held += std::abs(miss(Modulus::cortex, cell.cortex_mN_m)) < 1.645 * e.error(Modulus::cortex);
    if (e.status != ModuliStatus::resolved) return;
    const double young_ratio = e.value(Modulus::young) / cell.young_kPa,
                 cortex_ratio = e.value(Modulus::cortex) / cell.cortex_mN_m;
    beyond += std::max(young_ratio, 1 / young_ratio) > 2 || std::max(cortex_ratio, 1 / cortex_ratio) > 2;
    young.push_back(std::abs(miss(Modulus::young, cell.young_kPa) / cell.young_kPa));
    cortex.push_back(std::abs(miss(Modulus::cortex, cell.cortex_mN_m) / cell.cortex_mN_m));
  }

  static std::string spread(std::vector<double> numbers) {
    if (numbers.empty()) return "none";
    std::ranges::sort(numbers);
    return fmt::format("median {:.2e}, 90 % below {:.2e}", numbers[numbers.size() / 2],
                       numbers[numbers.size() * 9 / 10]);
  }

  void print(const std::string& what) const {
    fmt::print("{}: {} fits, {} resolved, {} not told apart, {} other\n  E: {}\n  E2D: {}\n", what, fits, resolved,
               unresolved, other, spread(young), spread(cortex));
    if (resolved > 0)
      fmt::print("  resolved, but a modulus is wrong by more than a factor of two: {:.1f} %\n",
                 100.0 * beyond / resolved);
    fmt::print("  90 % intervals that hold the truth: E {:.1f} %, E2D {:.1f} %\n", 100.0 * young_held / fits,
               100.0 * cortex_held / fits);
  }
};

}  // namespace

int rheocyte::measure(int argc, char** argv) {
  if (argc < 3) return fmt::print("check_combined TABLE-FOLDER RESULT-FOLDERS...\n"), 2;
  const CombinedTable table = read_combined_table(argv[1]);
  const CombinedInterpolation between(table);
  const FlowConditions conditions = conditions_of(table.spec);
  const PixelLaw law(between, pixel_um);
  const SeveralModuli by_figure(between, conditions, {features_of_figure()}),
      by_contour(between, conditions, {features_of_contour()});
  ShapeErrors fine;
  fine.covariance.diagonal().setConstant(1e-8);
  Tally exact_figure, exact_contour, pixel_figure, pixel_contour;
  std::vector<double> stiffness, modes;
  CellRandom random(7, 0, Purpose::place);
  for (int i = 2; i < argc; ++i) {
    const SolvedCell cell = read_cell(argv[i]);
    const ShapeVector shape = shape_vector(outline_shape(cell.outline));
    const double S = cell.young_kPa + cell.cortex_mN_m / cell.radius_um;
    const CellCoordinates place(std::log(cell.radius_um), 1 - cell.young_kPa / S, std::log(shape(1)),
                                between.tension_ratios().front());
    const CombinedState state = between.at(place);
    if (!state.inside) continue;
    stiffness.push_back(std::abs(state.value(log_stiffness_row) - std::log(S)));
    modes.push_back((state.value.tail<mode_count>() - shape.tail<mode_count>()).cwiseAbs().maxCoeff());
    exact_figure.take(by_figure.fit({shape, fine}, conditions), cell);
    exact_contour.take(by_contour.fit({shape, fine}, conditions), cell);
    for (int k = 0; k < positions; ++k) {
      const double x = random.uniform() - 0.5, y = random.uniform() - 0.5;
      const auto seen = features_in_pixels(cell.outline, pixel_um, {x, y});
      pixel_figure.take(fit_pixels(by_figure, law, seen, conditions), cell);
      pixel_contour.take(fit_pixels(by_contour, law, seen, conditions), cell);
    }
  }
  fmt::print("{} cells inside the table\ninterpolation: ln S {}; modes {}\n", stiffness.size(),
             Tally::spread(stiffness), Tally::spread(modes));
  exact_figure.print("exact contour, area, d and Lambda1/Lambda2");
  exact_contour.print("exact contour, area and modes 2 .. 6");
  pixel_figure.print("pixels, area, d and Lambda1/Lambda2");
  pixel_contour.print("pixels, area and modes 2 .. 6");
  return 0;
}

// How well moduli come back through a combined table: check_combined TABLE-FOLDER RESULT-FOLDERS...
// Without results only this: by how much the two descriptions of the errors of pixels differ on the table's cells.
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

#include "infer/rendered_errors.h"
#include "measurement/pixel_errors.h"
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

/// Rendered errors and the fitted law (measurement/pixel_errors.h) at cells of one share, deformation by deformation.
void print_errors_of_pixels(const CombinedInterpolation& table, const RenderedErrors& rendered) {
  constexpr int area = int(ShapeFeature::area_um2), deformation = int(ShapeFeature::deformation);
  fmt::print("share d: bias of ln A rendered, fitted; of d; standard deviation of ln A; of d (means over the radii)\n");
  for (const double share : {0.0, 0.5, 1.0})
    for (const double d : {0.003, 0.01, 0.02, 0.04}) {
      Eigen::Array<double, 8, 1> sum = Eigen::Array<double, 8, 1>::Zero();
      int count = 0;
      for (const double radius : {4.5, 5.5, 6.5, 7.5}) {
        const CellCoordinates cell(std::log(radius), share, std::log(d), table.tension_ratios().front());
        const CombinedState state = table.at(cell);
        if (!state.inside) continue;
        const ShapeErrors errors = rendered.at(cell);
        const double log_area_px = state.value(log_area_row) - 2 * std::log(pixel_um);
        const PixelShape seen = seen_through_pixels({std::exp(log_area_px), d});
        const PixelErrors law = pixel_errors(std::log(seen.area_px), seen.deformation);
        Eigen::Array<double, 8, 1> row;
        row << errors.bias(area), std::log(seen.area_px) - log_area_px, errors.bias(deformation), seen.deformation - d,
            std::sqrt(errors.covariance(area, area)), law.area_deviation,
            std::sqrt(errors.covariance(deformation, deformation)), law.deformation_deviation;
        sum += row;
        ++count;
      }
      if (count == 0) continue;
      sum /= count;
      fmt::print("{} {}: {:.4f} {:.4f}; {:.5f} {:.5f}; {:.4f} {:.4f}; {:.5f} {:.5f}\n", share, d, sum(0), sum(1),
                 sum(2), sum(3), sum(4), sum(5), sum(6), sum(7));
    }
}

}  // namespace

int rheocyte::measure(int argc, char** argv) {
  if (argc < 2) return fmt::print("check_combined TABLE-FOLDER RESULT-FOLDERS...\n"), 2;
  const CombinedTable table = read_combined_table(argv[1]);
  const CombinedInterpolation between(table);
  const FlowConditions conditions = conditions_of(table.spec);
  const RenderedErrors pixels(between, pixel_um);
  print_errors_of_pixels(between, pixels);
  if (argc == 2) return 0;
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
      pixel_figure.take(fit_pixels(by_figure, pixels, seen, conditions), cell);
      pixel_contour.take(fit_pixels(by_contour, pixels, seen, conditions), cell);
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

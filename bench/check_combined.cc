// What a combined table says between its branches, against cells that were solved directly:
// check_combined TABLE-FOLDER RESULT-FOLDERS...
//
// The results are of `rheocyte solve` in the table's channel, at the tension of the table's first sheets. Compared are
// stiffness, modes and outline at the cell's radius, fraction and deformation, the outline of a virtual cell of these
// moduli, and the moduli that the exact contour gives. (Moduli from pixels: `rheocyte synth`, round_trip_moduli.)
// Without results: by how much the two descriptions of the errors of pixels differ on the table's cells.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "infer/bulk_cortex_fit.h"
#include "infer/rendered_errors.h"
#include "measurement/pixel_errors.h"
#include "numeric/quantile.h"
#include "program.h"
#include "synth/combined_shapes.h"
#include "synth/outline.h"
#include "table/table_folder.h"

namespace {

using namespace rheocyte;

struct SolvedCell {
  double radius_um, young_kPa, cortex_mN_m, tension_mN_m;
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
  const auto number = [&](const char* part, const char* key) {
    const auto found = cell.at(part).find(key);
    return found == cell.at(part).end() || !found->is_number() ? 0. : found->get<double>();
  };
  const double cortex = number("cortex", "modulus_mN_per_m");
  return {cell.at("radius_um"), number("bulk", "young_modulus_kPa"), cortex, number("cortex", "tension_ratio") * cortex,
          mirrored(meridian)};
}

/// The silhouette about the centroid of its hull, which is all that features see.
Eigen::MatrixX2d centred(const Eigen::MatrixX2d& outline) {
  const OutlineShape shape = outline_shape(outline);
  return outline.rowwise() - Eigen::RowVector2d(shape.x, shape.y);
}

/// From a point to the nearest edge of a closed polygon.
double distance(const Eigen::RowVector2d& point, const Eigen::MatrixX2d& polygon) {
  double least = INFINITY;
  for (Eigen::Index i = 0; i < polygon.rows(); ++i) {
    const Eigen::RowVector2d a = polygon.row(i), edge = polygon.row((i + 1) % polygon.rows()) - a;
    const double along = std::clamp((point - a).dot(edge) / std::max(edge.squaredNorm(), 1e-300), 0., 1.);
    least = std::min(least, (point - a - along * edge).norm());
  }
  return least;
}

/// How far the outline of a solved cell is from another one, at most, in um.
double distance_um(const Eigen::MatrixX2d& solved, const Eigen::MatrixX2d& other) {
  const Eigen::MatrixX2d a = centred(solved), b = centred(other);
  double greatest = 0;
  for (Eigen::Index i = 0; i < a.rows(); ++i) greatest = std::max(greatest, distance(a.row(i), b));
  return greatest;
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

  static std::string spread(const std::vector<double>& numbers) {
    if (numbers.empty()) return "none";
    return fmt::format("median {:.2e}, 90 % below {:.2e}", quantile(numbers, 0.5), quantile(numbers, 0.9));
  }

  void print(const std::string& what) const {
    fmt::print("{}: {} fits, {} resolved, {} not determined separately, {} other\n  E: {}\n  E2D: {}\n", what, fits,
               resolved, unresolved, other, spread(young), spread(cortex));
    if (resolved > 0)
      fmt::print("  resolved, but a modulus is wrong by more than a factor of two: {:.1f} %\n",
                 100.0 * beyond / resolved);
    fmt::print("  90 % intervals that hold the truth: E {:.1f} %, E2D {:.1f} %\n", 100.0 * young_held / fits,
               100.0 * cortex_held / fits);
  }
};

/// What is collected over the cells.
struct Comparison {
  std::vector<double> stiffness, modes, outline, outline_of_modes, deformation;
  int missing = 0;

  void take(const SolvedCell& cell, const CombinedInterpolation& between, const CombinedShapes& shapes,
            double viscosity_mPas) {
    const ShapeVector shape = shape_vector(outline_shape(cell.outline));
    const double S = cell.young_kPa + cell.cortex_mN_m / cell.radius_um;
    const CombinedState state = between.at(place_of(cell, between));
    stiffness.push_back(std::abs(state.value(log_stiffness_row) - std::log(S)));
    modes.push_back((state.value.tail<mode_count>() - shape.tail<mode_count>()).cwiseAbs().maxCoeff());
    const Eigen::MatrixX2d seen = silhouette(cell.outline.topRows(cell.outline.rows() / 2 + 1));
    std::array<double, mode_count> own{};
    for (int k = 0; k < mode_count; ++k) own[std::size_t(k)] = shape(first_mode_row + k);
    outline_of_modes.push_back(distance_um(seen, rheocyte::outline_of_modes(own, std::exp(shape(0)), 720)));
    const auto found =
        shapes.shape({cell.radius_um, cell.young_kPa, viscosity_mPas, cell.cortex_mN_m, cell.tension_mN_m});
    if (const auto* virtual_cell = std::get_if<CellShape>(&found)) {
      outline.push_back(distance_um(seen, silhouette(virtual_cell->meridian)));
      deformation.push_back(std::abs(outline_shape(mirrored(virtual_cell->meridian)).deformation / shape(1) - 1));
    } else {
      ++missing;
    }
  }

  static CellCoordinates place_of(const SolvedCell& cell, const CombinedInterpolation& between) {
    const double S = cell.young_kPa + cell.cortex_mN_m / cell.radius_um;
    return {std::log(cell.radius_um), 1 - cell.young_kPa / S, std::log(outline_shape(cell.outline).deformation),
            between.tension_ratios().front(), 0.0};
  }
};

constexpr double pixel_um = 0.34;

/// Rendered errors and the fitted law (measurement/pixel_errors.h) at cells of one fraction, deformation by
/// deformation.
void print_errors_of_pixels(const CombinedInterpolation& table, const RenderedErrors& rendered) {
  constexpr int area = int(ShapeFeature::area_um2), deformation = int(ShapeFeature::deformation);
  fmt::print(
      "fraction d: bias of ln A rendered, fitted; of d; standard deviation of ln A; of d (means over the radii)\n");
  for (const double fraction : {0.0, 0.5, 1.0})
    for (const double d : {0.003, 0.01, 0.02, 0.04}) {
      Eigen::Array<double, 8, 1> sum = Eigen::Array<double, 8, 1>::Zero();
      int count = 0;
      for (const double radius : {4.5, 5.5, 6.5, 7.5}) {
        const CellCoordinates cell(std::log(radius), fraction, std::log(d), table.tension_ratios().front(), 0.0);
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
      fmt::print("{} {}: {:.4f} {:.4f}; {:.5f} {:.5f}; {:.4f} {:.4f}; {:.5f} {:.5f}\n", fraction, d, sum(0), sum(1),
                 sum(2), sum(3), sum(4), sum(5), sum(6), sum(7));
    }
}

}  // namespace

int rheocyte::measure(int argc, char** argv) {
  if (argc < 2) return fmt::print("check_combined TABLE-FOLDER RESULT-FOLDERS...\n"), 2;
  const std::filesystem::path name = argv[1];
  const TableFolder folder(name, read_table_spec(name / "spec.toml"));
  const CombinedInterpolation between(read_combined_table(name));
  const ChannelFlow flow = channel_flow_of(folder.spec().base);
  if (argc == 2) return print_errors_of_pixels(between, RenderedErrors(between, pixel_um)), 0;
  const CombinedShapes shapes(folder.spec(), folder.read_all(), {flow, flow});
  const BulkCortexFit by_figure(between, flow, {features_of_figure()}),
      by_contour(between, flow, {features_of_contour()});
  ShapeErrors fine;
  fine.covariance.diagonal().setConstant(1e-8);
  Tally exact_figure, exact_contour;
  Comparison comparison;
  for (int i = 2; i < argc; ++i) {
    const SolvedCell cell = read_cell(argv[i]);
    if (!between.at(Comparison::place_of(cell, between)).inside) continue;
    comparison.take(cell, between, shapes, flow.viscosity_mPas);
    const ShapeVector shape = shape_vector(outline_shape(cell.outline));
    exact_figure.take(by_figure.fit({shape, fine}, flow), cell);
    exact_contour.take(by_contour.fit({shape, fine}, flow), cell);
  }
  fmt::print("{} cells inside the table, {} without an outline\ninterpolation: ln S {}; modes {}\n",
             comparison.stiffness.size(), comparison.missing, Tally::spread(comparison.stiffness),
             Tally::spread(comparison.modes));
  fmt::print("outlines of virtual cells: off by {} um; deformation {}\nthose of the exact modes: {} um\n",
             Tally::spread(comparison.outline), Tally::spread(comparison.deformation),
             Tally::spread(comparison.outline_of_modes));
  exact_figure.print("exact contour, area, d and Lambda1/Lambda2");
  exact_contour.print("exact contour, area and modes 2 .. 6");
  return 0;
}

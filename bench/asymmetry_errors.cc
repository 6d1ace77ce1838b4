// Fits the law of c_3 in src/measurement/pixel_errors.cc: asymmetry_errors DIR [SHAPES [PLACES]]
//
// Cells of the table in DIR, with an added ellipse of random size, are drawn into masks of pixels at random places; the
// modes of the masks' contours are compared with those of the smooth contour. Prints the coefficients as they stand in
// the source, and how well they describe the masks.
#include <fmt/format.h>

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <vector>

#include "bare_branches.h"
#include "measurement/pixel_errors.h"
#include "measurement/shape_in_pixels.h"
#include "numeric/dense_solve.h"
#include "numeric/quantile.h"
#include "program.h"
#include "synth/branch_shapes.h"
#include "synth/outline.h"

namespace {

using namespace rheocyte;

constexpr double min_deformation = 3e-4, max_deformation = 0.1, max_ellipse = 0.25,
                 max_deviation = 1;  // in s^2
constexpr int second_mode = int(ShapeFeature::first_mode), third_mode = second_mode + 1;

/// One shape in one size of pixels; modes as measured, on average.
struct Seen {
  double log_area_px = 0, mode_2 = 0, mode_3 = 0, excess = 0, deviation = 0;
};

constexpr int powers_of_ellipse = 3, powers_of_asymmetry = 3, powers_of_size = 2,
              terms = powers_of_ellipse * powers_of_asymmetry * powers_of_size;

/// Powers of c_2, of |c_3| and of s = area^(-1/3).
Eigen::RowVectorXd basis(const Seen& seen) {
  const double s = std::exp(-seen.log_area_px / 3);
  Eigen::RowVectorXd row(terms);
  int at = 0;
  for (int i = 0; i < powers_of_ellipse; ++i)
    for (int j = 0; j < powers_of_asymmetry; ++j)
      for (int k = 0; k < powers_of_size; ++k)
        row(at++) = std::pow(seen.mode_2, i) * std::pow(std::abs(seen.mode_3), j) * std::pow(s, k);
  return row;
}

double square_of_s(const Seen& seen) { return std::exp(-2 * seen.log_area_px / 3); }

Eigen::VectorXd fitted(const std::vector<Seen>& all, const auto& scale, double Seen::*member) {
  Eigen::MatrixXd matrix(all.size(), terms);
  Eigen::VectorXd wanted(all.size());
  // Relative to the scatter by pixels of the same size, so that large and small cells count alike.
  for (std::size_t k = 0; k < all.size(); ++k) {
    const auto row = static_cast<Eigen::Index>(k);
    matrix.row(row) = basis(all[k]) * scale(all[k]) / square_of_s(all[k]);
    wanted(row) = all[k].*member / square_of_s(all[k]);
  }
  return least_squares(matrix, wanted);
}

std::vector<Seen> look_at_shapes(const CellShapes& shapes, const TableSpec& spec, int count, int places) {
  CellRandom random(3, 0, Purpose::place);
  std::vector<Seen> all;
  while (static_cast<int>(all.size()) < count) {
    const auto found = random_shape(shapes, spec, random, min_deformation, max_deformation);
    if (!found) continue;
    const double ellipse = random.uniform() < 0.5 ? 0 : max_ellipse * random.uniform();
    const double area_px = log_uniform(random, min_fitted_area_px, max_fitted_area_px);
    const Eigen::MatrixX2d outline =
        with_ellipse(silhouette(found->meridian), ellipse) * std::sqrt(area_px / found->area_um2);
    const ShapeErrors errors = errors_in_pixels(outline, 1, places, random);
    const ShapeVector truth = shape_vector(outline_shape(outline));
    const double deviation = std::sqrt(errors.covariance(third_mode, third_mode));
    if (!(deviation <= max_deviation * std::exp(-2 * truth(0) / 3))) continue;  // dents that come and go
    all.push_back({truth(0) + errors.bias(0), truth(second_mode) + errors.bias(second_mode),
                   truth(third_mode) + errors.bias(third_mode), errors.bias(third_mode), deviation});
  }
  return all;
}

void print(const char* name, const Eigen::VectorXd& coefficients) {
  fmt::print("constexpr AsymmetryLaw {}{{", name);
  for (int i = 0; i < terms; ++i) fmt::print("{}{:.6g}", i ? ", " : "", coefficients(i));
  fmt::print("}};\n");
}

}  // namespace

int rheocyte::measure(int argc, char** argv) {
  if (argc < 2) return fmt::print("asymmetry_errors DIR [SHAPES [PLACES]]\n"), 2;
  const TableSpec spec = read_table_spec(std::string(argv[1]) + "/spec.toml");
  std::vector<SampledBranch> branches = bare_branches(TableFolder(argv[1], spec));
  const ChannelFlow flow = channel_flow_of(spec.base);
  const BranchShapes shapes(std::move(branches), {flow, flow, false});
  const auto all =
      look_at_shapes(shapes, spec, argc > 2 ? std::atoi(argv[2]) : 2000, argc > 3 ? std::atoi(argv[3]) : 100);
  const auto by_mode = [](const Seen& seen) { return square_of_s(seen) * seen.mode_3; };
  const Eigen::VectorXd excess = fitted(all, by_mode, &Seen::excess);
  print("asymmetry_law", excess);
  for (const double low : {50., 200., 500., 1000., 3000.})
    for (const bool round : {true, false}) {
      std::vector<double> left, before;
      for (const auto& seen : all) {
        if (seen.log_area_px < std::log(low) || seen.log_area_px > std::log(low * 3)) continue;
        if ((std::abs(seen.mode_2) < 0.03) != round || std::abs(seen.mode_3) < 0.02) continue;
        const double law = (basis(seen) * excess)(0) * by_mode(seen);
        left.push_back(std::abs((seen.excess - law) / seen.mode_3));
        before.push_back(std::abs(seen.excess / seen.mode_3));
      }
      if (left.empty()) continue;
      const auto at = [](const std::vector<double>& v, double share) { return 100 * quantile(v, share); };
      fmt::print(stderr, "{:5.0f} px and more, {}: c_3 off by {:.1f} % ({:.1f}), with the law {:.1f} % ({:.1f})\n", low,
                 round ? "round    " : "elongated", at(before, 0.5), at(before, 0.95), at(left, 0.5), at(left, 0.95));
    }
  return 0;
}

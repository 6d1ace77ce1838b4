// Fits the laws of elongated cells in src/measurement/pixel_errors.cc: mode_errors DIR [SHAPES [PLACES]]
//
// Cells of the table of elongated cells in DIR, in random sizes, are drawn into masks of pixels at random places;
// modes, deformation and inertia ratio of the masks' contours are compared with those of the smooth contour. Prints the
// coefficients as they stand in the source, and how well they describe the masks.
#include <fmt/format.h>

#include <Eigen/Core>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <vector>

#include "bare_branches.h"
#include "measurement/pixel_errors.h"
#include "measurement/shape_in_pixels.h"
#include "numeric/dense_solve.h"
#include "numeric/quantile.h"
#include "program.h"

namespace {

using namespace rheocyte;

constexpr int deformation = int(ShapeFeature::deformation), moments = int(ShapeFeature::moment_ratio);

constexpr int place_of(int mode) { return int(ShapeFeature::first_mode) + mode - min_mode; }

/// One shape in one size of pixels, as measured on average, and what pixels have added.
struct Seen {
  double s;  ///< (area in pixels)^(-1/3)
  ShapeVector features;
  ShapeErrors errors;

  double mode(int k) const { return features(place_of(k)); }
  double inertia_ratio() const { return 1 / std::sqrt(features(moments)); }
  double inertia_excess() const { return inertia_ratio() - 1 / std::sqrt(features(moments) - errors.bias(moments)); }
  /// d(inertia ratio) / d(moment ratio)
  double inertia_slope() const { return -0.5 * std::pow(features(moments), -1.5); }
  double deviation(int feature) const { return std::sqrt(errors.covariance(feature, feature)); }
};

std::vector<Seen> look_at_shapes(const std::vector<SampledBranch>& branches, int count, int places) {
  CellRandom random(3, 0, Purpose::place);
  std::vector<Seen> all;
  while (std::ssize(all) < count) {
    const auto any = [&](auto size) { return std::min(std::size_t(random.uniform() * double(size)), size - 1); };
    const SampledBranch& branch = branches[any(branches.size())];
    if (branch.empty()) continue;
    const Eigen::MatrixX2d outline = mirrored(branch.contour[any(std::size_t(branch.samples()))]);
    const double area_px = log_uniform(random, min_fitted_area_px, max_fitted_area_px);
    const Eigen::MatrixX2d drawn = outline * std::sqrt(area_px / outline_shape(outline).area);
    const ShapeErrors errors = errors_in_pixels(drawn, 1, places, random);
    const ShapeVector features = shape_vector(outline_shape(drawn)) + errors.bias;
    all.push_back({std::exp(-features(0) / 3), features, errors});
  }
  return all;
}

/// Of the scatter of two features.
double correlation(const Seen& seen, int one, int other) {
  return seen.errors.covariance(one, other) / (seen.deviation(one) * seen.deviation(other));
}

/// A number of a shape, and the terms of its law; in units of s^2, so that large and small cells count alike, and by
/// its weight.
struct Law {
  const char* name;
  std::function<double(const Seen&)> number;
  std::function<std::vector<double>(const Seen&)> terms;
  std::function<double(const Seen&)> weight = [](const Seen&) { return 1.0; };
};

/// Powers of two numbers up to these, those of s, 0 and 1, running fastest.
std::vector<double> products(double x, int most_x, double y, int most_y, double s) {
  std::vector<double> terms;
  for (int i = 0; i <= most_x; ++i)
    for (int j = 0; j <= most_y; ++j)
      for (const double c : {1.0, s}) terms.push_back(std::pow(x, i) * std::pow(y, j) * c);
  return terms;
}

/// A number that stays as it is when the cell is turned about, and one that changes its sign.
std::vector<double> even_terms(const Seen& seen) {
  auto terms = products(seen.mode(2), 2, std::abs(seen.mode(3)), 2, seen.s);
  for (const double term : products(seen.mode(2), 1, std::abs(seen.mode(3)), 1, seen.s))
    terms.push_back(seen.mode(4) * term);
  return terms;
}
std::vector<double> odd_terms(const Seen& seen) {
  auto terms = products(seen.mode(2), 2, std::abs(seen.mode(3)), 3, seen.s);
  for (double& term : terms) term *= seen.mode(3);
  for (const double term : products(seen.mode(2), 1, std::abs(seen.mode(3)), 1, seen.s))
    terms.push_back(seen.mode(5) * term);
  return terms;
}
std::vector<double> terms_by_inertia(const Seen& seen) {
  return products(seen.features(deformation), 2, seen.inertia_ratio() - 1, 2, seen.s);
}
std::vector<double> deviation_terms(const Seen& seen) {
  const double second = seen.mode(2), third = std::abs(seen.mode(3));
  return {1, third, second, third * third, second * second, third * second, seen.s};
}

void fit(const Law& law, const std::vector<Seen>& all) {
  const auto terms = Eigen::Index(law.terms(all.front()).size());
  Eigen::MatrixXd matrix(std::ssize(all), terms);
  Eigen::VectorXd wanted(std::ssize(all)), weights(std::ssize(all));
  for (Eigen::Index k = 0; k < std::ssize(all); ++k) {
    const Seen& seen = all[std::size_t(k)];
    const auto row = law.terms(seen);
    matrix.row(k) = Eigen::Map<const Eigen::RowVectorXd>(row.data(), terms);
    wanted(k) = law.number(seen) / (seen.s * seen.s);
    weights(k) = law.weight(seen);
  }
  const Eigen::VectorXd found = least_squares(weights.asDiagonal() * matrix, weights.asDiagonal() * wanted);
  std::vector<double> left, before;
  const Eigen::VectorXd rest = wanted - matrix * found;
  for (Eigen::Index k = 0; k < rest.size(); ++k)
    left.push_back(std::abs(rest(k))), before.push_back(std::abs(wanted(k)));
  fmt::print("{}{{", law.name);
  for (Eigen::Index i = 0; i < terms; ++i) fmt::print("{}{:.5g}", i ? ", " : "", found(i));
  fmt::print("}};\n");
  fmt::print(stderr, "{}: {:.3g} ({:.3g}) s^2, with the law {:.3g} ({:.3g}, root mean square {:.3g}); median (95 %)\n",
             law.name, quantile(before, 0.5), quantile(before, 0.95), quantile(left, 0.5), quantile(left, 0.95),
             std::sqrt(rest.squaredNorm() / double(rest.size())));
}

std::vector<Law> laws() {
  const auto bias = [](int mode) { return [mode](const Seen& seen) { return seen.errors.bias(place_of(mode)); }; };
  const auto scatter = [](int mode) { return [mode](const Seen& seen) { return seen.deviation(place_of(mode)); }; };
  // Of moduli the relative error counts: they are as the inverse of the third mode.
  const auto by_asymmetry = [](const Seen& seen) { return 1 / (std::abs(seen.mode(3)) + 0.01); };
  const auto by_deformation = [](const Seen& seen) { return 1 / (seen.features(deformation) + 0.01); };
  const auto bias_of_deformation = [](const Seen& seen) { return seen.errors.bias(deformation); };
  const auto scatter_of_deformation = [](const Seen& seen) { return seen.deviation(deformation); };
  return {
      {"mode_2_law", bias(2), even_terms},
      {"mode_3_law", bias(3), odd_terms, by_asymmetry},
      {"mode_4_law", bias(4), even_terms},
      {"mode_5_law", bias(5), odd_terms, by_asymmetry},
      {"deformation_by_modes", bias_of_deformation, even_terms, by_deformation},
      {"inertia_by_modes", &Seen::inertia_excess, even_terms},
      {"mode_2_deviation", scatter(2), deviation_terms},
      {"mode_3_deviation", scatter(3), deviation_terms},
      {"mode_4_deviation", scatter(4), deviation_terms},
      {"mode_5_deviation", scatter(5), deviation_terms},
      {"mode_correlation",
       [](const Seen& seen) { return correlation(seen, place_of(2), place_of(3)) * seen.s * seen.s; }, even_terms},
      {"long_deformation_law", bias_of_deformation, terms_by_inertia},
      {"inertia_law", &Seen::inertia_excess, terms_by_inertia},
      {"long_deformation_deviation", scatter_of_deformation, deviation_terms},
      {"inertia_deviation", [](const Seen& seen) { return std::abs(seen.inertia_slope()) * seen.deviation(moments); },
       deviation_terms},
      {"inertia_correlation",
       [](const Seen& seen) { return -correlation(seen, deformation, moments) * seen.s * seen.s; }, terms_by_inertia},
  };
}

}  // namespace

int rheocyte::measure(int argc, char** argv) {
  if (argc < 2) return fmt::print("mode_errors DIR [SHAPES [PLACES]]\n"), 2;
  const TableSpec spec = read_table_spec(std::string(argv[1]) + "/spec.toml");
  const auto all = look_at_shapes(bare_branches(TableFolder(argv[1], spec)), argc > 2 ? std::atoi(argv[2]) : 5000,
                                  argc > 3 ? std::atoi(argv[3]) : 300);
  for (const Law& law : laws()) fit(law, all);
  return 0;
}

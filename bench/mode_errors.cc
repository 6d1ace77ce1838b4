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

constexpr int second_mode = int(ShapeFeature::first_mode), third_mode = second_mode + 1,
              deformation = int(ShapeFeature::deformation), moments = int(ShapeFeature::moment_ratio);

/// One shape in one size of pixels, as measured on average, and what pixels have added.
struct Seen {
  double s;  ///< (area in pixels)^(-1/3)
  ShapeVector features;
  ShapeErrors errors;

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

/// A number of a shape, and the terms of its law; all in units of s^2, so that large and small cells count alike.
struct Law {
  const char* name;
  std::function<double(const Seen&)> number;
  std::function<std::vector<double>(const Seen&)> terms;
};

/// Powers of two numbers from (0, 0) to (2, 2), those of s running fastest.
std::vector<double> products(double x, double y, double s) {
  std::vector<double> terms;
  for (const double a : {1.0, x, x * x})
    for (const double b : {1.0, y, y * y})
      for (const double c : {1.0, s}) terms.push_back(a * b * c);
  return terms;
}

void fit(const Law& law, const std::vector<Seen>& all) {
  const auto terms = Eigen::Index(law.terms(all.front()).size());
  Eigen::MatrixXd matrix(std::ssize(all), terms);
  Eigen::VectorXd wanted(std::ssize(all));
  for (Eigen::Index k = 0; k < std::ssize(all); ++k) {
    const Seen& seen = all[std::size_t(k)];
    const auto row = law.terms(seen);
    matrix.row(k) = Eigen::Map<const Eigen::RowVectorXd>(row.data(), terms);
    wanted(k) = law.number(seen) / (seen.s * seen.s);
  }
  const Eigen::VectorXd found = least_squares(matrix, wanted);
  std::vector<double> left, before;
  const Eigen::VectorXd rest = wanted - matrix * found;
  for (Eigen::Index k = 0; k < rest.size(); ++k)
    left.push_back(std::abs(rest(k))), before.push_back(std::abs(wanted(k)));
  fmt::print("{}{{", law.name);
  for (Eigen::Index i = 0; i < terms; ++i) fmt::print("{}{:.5g}", i ? ", " : "", found(i));
  fmt::print("}};\n");
  fmt::print(stderr, "{}: {:.3g} ({:.3g}) s^2, with the law {:.3g} ({:.3g}); median (95 %)\n", law.name,
             quantile(before, 0.5), quantile(before, 0.95), quantile(left, 0.5), quantile(left, 0.95));
}

}  // namespace

int rheocyte::measure(int argc, char** argv) {
  if (argc < 2) return fmt::print("mode_errors DIR [SHAPES [PLACES]]\n"), 2;
  const TableSpec spec = read_table_spec(std::string(argv[1]) + "/spec.toml");
  const auto all = look_at_shapes(bare_branches(TableFolder(argv[1], spec)), argc > 2 ? std::atoi(argv[2]) : 2000,
                                  argc > 3 ? std::atoi(argv[3]) : 100);
  const auto by_modes = [](const Seen& seen) {
    return products(seen.features(second_mode), std::abs(seen.features(third_mode)), seen.s);
  };
  const auto by_mode_3 = [&](const Seen& seen) {
    auto terms = by_modes(seen);
    for (double& term : terms) term *= seen.features(third_mode);
    return terms;
  };
  const auto by_inertia = [](const Seen& seen) {
    return products(seen.features(deformation), seen.inertia_ratio() - 1, seen.s);
  };
  const auto linear = [](const Seen& seen) {
    return std::vector{1.0, std::abs(seen.features(third_mode)), seen.features(second_mode)};
  };
  for (const Law& law : {
           Law{"mode_2_law", [](const Seen& seen) { return seen.errors.bias(second_mode); }, by_modes},
           Law{"mode_3_law", [](const Seen& seen) { return seen.errors.bias(third_mode); }, by_mode_3},
           Law{"mode_2_deviation", [](const Seen& seen) { return seen.deviation(second_mode); }, linear},
           Law{"mode_3_deviation", [](const Seen& seen) { return seen.deviation(third_mode); }, linear},
           Law{"long_deformation_law", [](const Seen& seen) { return seen.errors.bias(deformation); }, by_inertia},
           Law{"inertia_law", &Seen::inertia_excess, by_inertia},
           Law{"long_deformation_deviation", [](const Seen& seen) { return seen.deviation(deformation); }, linear},
           Law{"inertia_deviation",
               [](const Seen& seen) { return std::abs(seen.inertia_slope()) * seen.deviation(moments); }, linear},
           Law{"mode_correlation",
               [](const Seen& seen) { return correlation(seen, second_mode, third_mode) * seen.s * seen.s; }, by_modes},
           Law{"inertia_correlation",
               [](const Seen& seen) { return -correlation(seen, deformation, moments) * seen.s * seen.s; }, by_inertia},
       })
    fit(law, all);
  return 0;
}

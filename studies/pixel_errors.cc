// Fits the law of src/measurement/pixel_errors.cc: pixel_errors SHAPES PLACES DIR-OR-GRID...
//
// Cells of random size and deformation from each table, as many of each, are drawn into masks of pixels at random
// places, in pixels of random size. A grid keeps six modes of each cell, which is enough up to a deformation of 0.06;
// the folder of a table has the contours themselves. Area and deformation of the masks' contours are compared with
// those of the smooth contour. Prints the coefficients as they stand in the source, and how well they describe the
// masks of each table. How often the standard errors contain the truth, also for cells of other tables, is reported
// by pixel_coverage.
#include <fmt/format.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "bare_branches.h"
#include "grid_outlines.h"
#include "measurement/contour_features.h"
#include "measurement/contour_from_mask.h"
#include "measurement/mask_from_outline.h"
#include "numeric/dense_solve.h"
#include "numeric/quantile.h"
#include "program.h"
#include "synth/branch_shapes.h"
#include "synth/outline.h"

namespace {

using namespace rheocyte;

constexpr int powers_of_deformation = 4, powers_of_size = 3, terms = powers_of_deformation * powers_of_size;
constexpr double min_area_px = 50, max_area_px = 9000, min_deformation = 3e-4, max_deformation = 0.2,
                 max_deformation_of_modes = 0.06;

/// A shape seen at many places. "Log ratio": ln(smooth area / measured area); excess: measured - smooth deformation.
struct Seen {
  double log_area_px = 0, deformation = 0;  ///< means, as measured
  double log_ratio = 0, excess = 0;         ///< means
  Eigen::MatrixX2d places;                  ///< the measured ln(area) and deformation at each place
  double smooth_log_area = 0, smooth_deformation = 0;
  std::size_t table = 0;  ///< of which it is
};

class RenderingCamera {
 public:
  Seen look(const Eigen::MatrixX2d& outline_um, double area_px, int places) {
    const OutlineShape shape = outline_shape(outline_um);
    const Eigen::MatrixX2d outline = outline_um * std::sqrt(area_px / shape.area);
    const Eigen::RowVector2d low = outline.colwise().minCoeff(), high = outline.colwise().maxCoeff();
    const ImageSize size{static_cast<std::size_t>(high.x() - low.x()) + 4,
                         static_cast<std::size_t>(high.y() - low.y()) + 4};
    std::vector<std::uint8_t> mask(size.pixels());
    Seen seen;
    seen.places.resize(places, 2);
    seen.smooth_log_area = std::log(area_px);
    seen.smooth_deformation = shape.deformation;
    for (int i = 0; i < places; ++i) {
      const Eigen::RowVector2d shift(1 + unit_(random_), 1 + unit_(random_));
      fill_mask((outline.rowwise() + (shift - low)).eval(), size, mask);
      const auto features = measurer_.measure(finder_.contour_of({size, mask}), 1);
      seen.places.row(i) << std::log(features.area_um2), features.deformation;
    }
    seen.log_area_px = seen.places.col(0).mean();
    seen.deformation = seen.places.col(1).mean();
    seen.log_ratio = seen.smooth_log_area - seen.log_area_px;
    seen.excess = seen.deformation - seen.smooth_deformation;
    return seen;
  }

 private:
  std::mt19937_64 random_{7};
  std::uniform_real_distribution<double> unit_{0, 1};
  ContourFinder finder_;
  ContourMeasurer measurer_;
};

double size_of(double log_area_px) { return std::exp(-log_area_px / 3); }

Eigen::RowVectorXd basis(double log_area_px, double deformation) {
  const double s = size_of(log_area_px);
  Eigen::RowVectorXd row(terms);
  for (int i = 0; i < powers_of_deformation; ++i)
    for (int j = 0; j < powers_of_size; ++j) row(i * powers_of_size + j) = std::pow(deformation, i) * std::pow(s, j);
  return row;
}

/// Least squares for value = s^2 times (or once) a polynomial.
class Law {
 public:
  template <class Value>
  Law(const std::vector<Seen>& all, bool by_square, const Value& value) : by_square_(by_square) {
    Eigen::MatrixXd matrix(all.size(), terms);
    Eigen::VectorXd wanted(all.size());
    for (std::size_t k = 0; k < all.size(); ++k) {
      const auto row = static_cast<Eigen::Index>(k);
      const double s = size_of(all[k].log_area_px);
      matrix.row(row) = basis(all[k].log_area_px, all[k].deformation);
      wanted(row) = value(all[k]) / (by_square ? s * s : 1);
    }
    coefficients_ = least_squares(matrix, wanted);
  }

  double at(double log_area_px, double deformation) const {
    const double s = size_of(log_area_px);
    return basis(log_area_px, deformation).dot(coefficients_) * (by_square_ ? s * s : 1);
  }

  /// Shapes scatter differently: raised to where the mean square of scatter over law is 1, as intervals want it.
  template <class Value>
  void raise_to(const std::vector<Seen>& all, const Value& value) {
    double squares = 0;
    for (const Seen& seen : all) squares += std::pow(value(seen) / at(seen.log_area_px, seen.deformation), 2);
    coefficients_ *= std::sqrt(squares / double(all.size()));
  }

  void print(const char* name) const {
    fmt::print("constexpr Law {}{{{{", name);
    for (int i = 0; i < powers_of_deformation; ++i) {
      fmt::print("{}{{", i ? ", " : "");
      for (int j = 0; j < powers_of_size; ++j)
        fmt::print("{}{:.6g}", j ? ", " : "", coefficients_(i * powers_of_size + j));
      fmt::print("}}");
    }
    fmt::print("}}}};\n");
  }

 private:
  bool by_square_;
  Eigen::VectorXd coefficients_;
};

/// Outline of a random cell of a table; without rows where it has none of the wanted kind.
using RandomOutline = std::function<Eigen::MatrixX2d(CellRandom&)>;

RandomOutline outlines_of_grid(const std::string& file) {
  const auto shapes = std::make_shared<ShapeGrid>(grid_in(file).shapes.value());
  return [shapes](CellRandom& random) {
    const ShapeNodes& nodes = shapes->nodes();
    const double column = random.uniform() * (nodes.columns - 1);
    const double last = std::min(std::exp(nodes.upper[std::size_t(column)]), max_deformation_of_modes);
    return outline_in(*shapes, std::exp(nodes.min_log_area + column * nodes.column_step),
                      log_uniform(random, min_deformation, last));
  };
}

RandomOutline outlines_of_folder(const std::string& folder) {
  const TableSpec spec = read_table_spec(folder + "/spec.toml");
  const ChannelFlow flow = channel_flow_of(spec.base);
  auto branches = TableFolder(folder, spec).all_branches();
  std::erase_if(branches, [](const SampledBranch& branch) { return branch.empty(); });
  const auto shapes = std::make_shared<BranchShapes>(std::move(branches), SimulatedCells{flow, flow, false});
  return [shapes, spec](CellRandom& random) -> Eigen::MatrixX2d {
    const auto found = random_shape(*shapes, spec, random, min_deformation, max_deformation);
    if (!found) return {};
    return silhouette(found->meridian);
  };
}

std::vector<Seen> look_at_shapes(const std::vector<std::string>& tables, int count, int places) {
  RenderingCamera camera;
  std::vector<Seen> all;
  for (std::size_t table = 0; table < tables.size(); ++table) {
    const bool is_folder = std::filesystem::is_directory(tables[table]);
    const RandomOutline outlines = is_folder ? outlines_of_folder(tables[table]) : outlines_of_grid(tables[table]);
    CellRandom random(3, table, Purpose::place);
    for (int i = 0; i < count;) {
      const Eigen::MatrixX2d outline = outlines(random);
      if (outline.rows() == 0) continue;
      all.push_back(camera.look(outline, log_uniform(random, min_area_px, max_area_px), places));
      all.back().table = table;
      ++i;
    }
  }
  return all;
}

/// Differences from the smooth contour after the correction.
Eigen::MatrixX2d residuals(const Seen& seen, const Law& log_ratio, const Law& excess) {
  Eigen::MatrixX2d left(seen.places.rows(), 2);
  for (Eigen::Index i = 0; i < left.rows(); ++i) {
    const double a = seen.places(i, 0), d = seen.places(i, 1);
    left.row(i) << a + std::log1p(log_ratio.at(a, d)) - seen.smooth_log_area,
        d - excess.at(a, d) - seen.smooth_deformation;
  }
  return left;
}

// About zero: what the mean law misses of a single shape counts as scatter.
Eigen::RowVector2d deviations(const Eigen::MatrixX2d& left) {
  return (left.colwise().squaredNorm() / static_cast<double>(left.rows())).cwiseSqrt();
}

}  // namespace

int rheocyte::measure(int argc, char** argv) {
  if (argc < 4) return fmt::print("pixel_errors SHAPES PLACES DIR-OR-GRID...\n"), 2;
  const std::vector<std::string> tables(argv + 3, argv + argc);
  const auto all = look_at_shapes(tables, std::atoi(argv[1]), std::atoi(argv[2]));
  const Law area(all, true, [](const Seen& s) { return std::expm1(s.log_ratio); });
  const Law excess(all, true, [](const Seen& s) { return s.excess; });
  std::vector<Eigen::MatrixX2d> left;
  for (const auto& seen : all) left.push_back(residuals(seen, area, excess));
  const auto of = [&](const Seen& seen) -> const Eigen::MatrixX2d& {
    return left[static_cast<std::size_t>(&seen - all.data())];
  };
  Law area_deviation(all, true, [&](const Seen& s) { return deviations(of(s))(0); });
  Law deformation_deviation(all, true, [&](const Seen& s) { return deviations(of(s))(1); });
  area_deviation.raise_to(all, [&](const Seen& s) { return deviations(of(s))(0); });
  deformation_deviation.raise_to(all, [&](const Seen& s) { return deviations(of(s))(1); });
  const Law correlation(all, false, [&](const Seen& s) {
    return of(s).col(0).dot(of(s).col(1)) / (of(s).col(0).norm() * of(s).col(1).norm());
  });
  area.print("area_law");
  excess.print("deformation_law");
  area_deviation.print("area_deviation_law");
  deformation_deviation.print("deformation_deviation_law");
  correlation.print("correlation_law");
  for (std::size_t table = 0; table < tables.size(); ++table)
    for (const double low : {50., 200., 500., 1000., 3000.}) {
      std::vector<double> area_left, excess_left, area_ratio, deformation_ratio;
      for (const auto& seen : all) {
        if (seen.table != table || seen.log_area_px < std::log(low) || seen.log_area_px > std::log(low * 3)) continue;
        area_left.push_back(std::abs(of(seen).col(0).mean()));
        excess_left.push_back(std::abs(of(seen).col(1).mean()));
        const auto d = deviations(of(seen));
        area_ratio.push_back(area_deviation.at(seen.log_area_px, seen.deformation) / d(0));
        deformation_ratio.push_back(deformation_deviation.at(seen.log_area_px, seen.deformation) / d(1));
      }
      if (area_left.empty()) continue;
      fmt::print(
          stderr,
          "{}, {:5.0f} px and more: left of ln(area) {:.1e} (95 % below {:.1e}), of the deformation {:.1e} ({:.1e}); "
          "fitted / seen deviations {:.2f} to {:.2f} and {:.2f} to {:.2f} (5, 95 %)\n",
          tables[table], low, quantile(area_left, 0.5), quantile(area_left, 0.95), quantile(excess_left, 0.5),
          quantile(excess_left, 0.95), quantile(area_ratio, 0.05), quantile(area_ratio, 0.95),
          quantile(deformation_ratio, 0.05), quantile(deformation_ratio, 0.95));
    }
  return 0;
}

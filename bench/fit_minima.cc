// Whether the fit of bulk and cortex finds the least chi squared: fit_minima TABLE.cbor [COUNT [SEED]]
//
// Virtual cells anywhere in a combined table, a third of them without a cortex, with the noise of pixels of 0.34 um,
// are fitted at their axial tension with the tension of their cortex known and unknown, and again from 30 starts around
// what was found.
#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cstdlib>
#include <random>

#include "infer/bulk_cortex_fit.h"
#include "infer/rendered_errors.h"
#include "program.h"
#include "table/combined_table.h"

namespace {

using namespace rheocyte;

constexpr int starts = 30, last_mode = 7;
constexpr double pixel_um = 0.34, relevant = 0.01, of_one_error = 1;  ///< of chi squared

class Cells {
 public:
  Cells(const CombinedTable& table, unsigned seed)
      : between_(table), flow_(channel_flow_of(table.spec.base)), errors_(between_, pixel_um), engine_(seed) {}

  /// How much chi squared is above the least one that another start finds.
  double excess(const BulkCortexFit& fit, CellCoordinates cell, bool free_tension) {
    MeasuredShape shape{fit.shape_of(cell, flow_), errors_.of(cell, CellRandom(1, engine_(), Purpose::picture))};
    shape.errors.bias.setZero();
    ShapeVector noise;
    for (double& number : noise) number = normal_(engine_);
    const Eigen::MatrixXd root = shape.errors.covariance.llt().matrixL();
    shape.features += root * noise;
    const AxialTension tension{fit.axial_tension_Pa(cell, flow_), 0};
    const auto found = fit.nearest(shape, flow_, tension);
    double least = found->chi_squared;
    for (int k = 0; k < starts; ++k) {
      CellCoordinates start = near(found->cell, k % 2 ? 0.02 : 0.2);
      if (!free_tension) start(x_ratio) = cell(x_ratio);
      least = std::min(least, fit.nearest(shape, flow_, tension, &start)->chi_squared);
    }
    return found->chi_squared - least;
  }

  BulkCortexFit fit(bool free_tension) const {
    return {between_, flow_, {features_of_contour(last_mode), free_tension, between_.tension_ratios().front()}};
  }

  CellCoordinates random_cell(bool has_cortex, bool free_tension) {
    const CellBox& box = between_.box();
    while (true) {
      CellCoordinates cell;
      for (int x = 0; x < coordinate_count; ++x)
        cell(x) = std::uniform_real_distribution(box.least(x), box.greatest(x))(engine_);
      if (!has_cortex) cell(x_fraction) = box.least(x_fraction);
      if (!free_tension) cell(x_ratio) = box.least(x_ratio);
      if (between_.is_inside(cell)) return cell;
    }
  }

 private:
  CellCoordinates near(const CellCoordinates& cell, double fraction_of_range) {
    const CellBox& box = between_.box();
    CellCoordinates start = cell;
    for (int x = 0; x < coordinate_count; ++x)
      start(x) += fraction_of_range * normal_(engine_) * (box.greatest(x) - box.least(x));
    return start.cwiseMax(box.least).cwiseMin(box.greatest);
  }

  CombinedInterpolation between_;
  ChannelFlow flow_;
  RenderedErrors errors_;
  std::mt19937 engine_;
  std::normal_distribution<double> normal_;
};

}  // namespace

int rheocyte::measure(int argc, char** argv) {
  if (argc < 2) return fmt::print("fit_minima TABLE.cbor [COUNT [SEED]]\n"), 2;
  const int count = argc > 2 ? std::atoi(argv[2]) : 200;
  Cells cells(read_combined_table(argv[1]), argc > 3 ? unsigned(std::atoi(argv[3])) : 1);
  for (const bool free_tension : {false, true}) {
    const BulkCortexFit fit = cells.fit(free_tension);
    int missed = 0, far = 0;
    double worst = 0;
    for (int i = 0; i < count; ++i) {
      const double excess = cells.excess(fit, cells.random_cell(i % 3 != 0, free_tension), free_tension);
      missed += excess > relevant;
      far += excess > of_one_error;
      worst = std::max(worst, excess);
    }
    fmt::print(
        "tension of the cortex {}: {} of {} fits above the least chi squared by more than {}, {} by more than {}, "
        "{:.2g} at most\n",
        free_tension ? "fitted" : "known", missed, count, relevant, far, of_one_error, worst);
  }
  return 0;
}

#include "table/grid_by_asymmetry.h"

#include <array>
#include <cmath>

namespace rheocyte {

namespace {

constexpr int rows = 64;

/// ln|c_3| of the cells of one area over ln(deformation).
class Asymmetry {
 public:
  Asymmetry(const ShapeGrid& shapes, double log_area) : shapes_(shapes), log_area_(log_area) {}

  double at(double log_deformation) const {
    return std::log(std::abs(shapes_.mode(3, log_area_, std::exp(log_deformation))));
  }

  /// Up to where it rises.
  double top(double lower, double upper) const {
    constexpr int steps = 400;
    double before = at(lower);
    for (int i = 1; i <= steps; ++i) {
      const double here = at(lower + (upper - lower) * i / steps);
      if (!(here > before)) return lower + (upper - lower) * (i - 1) / steps;
      before = here;
    }
    return upper;
  }

  /// The deformation between these that has a given asymmetry.
  double inverse(double wanted, double lower, double upper) const {
    for (int step = 0; step < 50; ++step) {
      const double middle = 0.5 * (lower + upper);
      (at(middle) < wanted ? lower : upper) = middle;
    }
    return 0.5 * (lower + upper);
  }

 private:
  const ShapeGrid& shapes_;
  double log_area_;
};

}  // namespace

std::optional<GridsByAsymmetry> grids_by_asymmetry(const StiffnessGrid& grid, const ShapeGrid& shapes) {
  const GridContent& content = grid.content();
  const GridPatch& bare = content.patches.front();
  GridContent made{content.origin, content.min_log_area, content.column_step, content.columns, {}};
  GridPatch patch;
  std::vector<double> mode_2;
  patch.first_column = bare.first_column;
  patch.columns = bare.columns;
  patch.rows = rows;
  for (int c = 0; c < bare.columns; ++c) {
    const double log_area = content.min_log_area + (bare.first_column + c) * content.column_step;
    constexpr double rim = 1e-9;
    const auto column = std::size_t(c);
    const double lower = bare.lower[column] + rim, end = bare.upper[column] - rim;
    const Asymmetry asymmetry(shapes, log_area);
    const double upper = asymmetry.top(lower, end);
    if (!(asymmetry.at(upper) > asymmetry.at(lower))) return {};
    patch.lower.push_back(asymmetry.at(lower));
    patch.upper.push_back(asymmetry.at(upper));
    patch.beyond.push_back(upper == end ? bare.beyond[column] : double(NoAnswer::too_soft));
    for (int row = 0; row < rows; ++row) {
      const double share = double(row) / (rows - 1);
      const double log_deformation =
          asymmetry.inverse((1 - share) * patch.lower.back() + share * patch.upper.back(), lower, upper);
      std::array<GridAnswer, 1> answer;
      grid.answer({&log_area, 1}, {&log_deformation, 1}, answer);
      patch.log_stiffness.push_back(answer[0].log_stiffness);
      patch.error.push_back(answer[0].error);
      mode_2.push_back(shapes.mode(2, log_area, std::exp(log_deformation)));
    }
  }
  made.patches.push_back(std::move(patch));
  GridsByAsymmetry both{made, std::move(made)};
  both.mode_2.patches.front().log_stiffness = std::move(mode_2);
  return both;
}

}  // namespace rheocyte

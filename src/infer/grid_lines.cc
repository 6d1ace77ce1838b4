#include "infer/grid_lines.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "case/user_error.h"

namespace rheocyte {

namespace {

constexpr int columns = 400;  // of the area, at equal steps
constexpr int halvings = 50;  // of a column's height, in which a modulus is looked for

}  // namespace

GridLineFinder::GridLineFinder(GridContent grid) : grid_(std::move(grid)) {
  if (grid_.origin().is_shell)
    throw UserError(fmt::format("The table {} holds moduli of a cortex (mN/m); lines need Young's moduli of solids.",
                                grid_.origin().identifier));
}

double GridLineFinder::area_at(int column) const {
  const auto& content = grid_.content();
  const double least = std::exp(content.least_log_area),
               greatest = std::exp(content.least_log_area + content.column_step * (content.columns - 1));
  return least + (greatest - least) * (column + 0.5) / columns;
}

std::vector<double> GridLineFinder::even_levels(int count) const {
  constexpr int steps = 2000;
  double greatest = 0;
  for (int i = 0; i < columns; ++i) greatest = std::max(greatest, std::exp(grid_.smooth_range(area_at(i))->upper));
  std::vector<double> along;
  for (int i = 0; i <= steps; ++i) {
    const double s = static_cast<double>(i) / steps;
    const auto answer = grid_.answer(area_at(0) + s * (area_at(columns - 1) - area_at(0)), (1 - s) * greatest);
    if (answer.reason == NoAnswer::none && !answer.regularised) along.push_back(std::exp(answer.log_stiffness));
  }
  std::vector<double> levels;
  for (int k = 0; k < count && !along.empty(); ++k) {
    const double share = (k + 0.3) / count;  // as the published lines
    levels.push_back(along[static_cast<std::size_t>(share * static_cast<double>(along.size()))]);
  }
  return levels;
}

// Moduli fall with the deformation.
LevelLine GridLineFinder::line(double modulus_kPa) const {
  LevelLine result{modulus_kPa, {}};
  const double wanted = std::log(modulus_kPa);
  for (int i = 0; i < columns; ++i) {
    const double area = area_at(i);
    const auto range = *grid_.smooth_range(area);
    double low = range.lower + 1e-9, high = range.upper - 1e-9;
    const auto stiffness = [&](double log_deformation) {
      return grid_.answer(area, std::exp(log_deformation)).log_stiffness;
    };
    if (!(stiffness(low) >= wanted && stiffness(high) <= wanted)) continue;
    for (int k = 0; k < halvings; ++k) {
      const double middle = 0.5 * (low + high);
      (stiffness(middle) > wanted ? low : high) = middle;
    }
    result.points.push_back({area, std::exp(low)});
  }
  return result;
}

LevelLines GridLineFinder::lines(std::span<const double> levels_kPa) const {
  const GridOrigin& o = grid_.origin();
  LevelLines result{o.identifier, o.channel_width_um, o.flow_rate_ul_s, o.viscosity_mPas, {}};
  for (const double level : levels_kPa) {
    LevelLine one = line(level);
    if (one.points.size() > 1) result.lines.push_back(std::move(one));
  }
  std::ranges::sort(result.lines, {}, &LevelLine::modulus_kPa);
  return result;
}

std::vector<PlanePoint> GridLineFinder::support() const {
  std::vector<PlanePoint> lower, upper;
  for (int i = 0; i < columns; ++i) {
    const auto range = *grid_.smooth_range(area_at(i));
    lower.push_back({area_at(i), std::exp(range.lower)});
    upper.push_back({area_at(i), std::exp(range.upper)});
  }
  lower.insert(lower.end(), upper.rbegin(), upper.rend());
  return lower;
}

}  // namespace rheocyte

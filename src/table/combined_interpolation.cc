#include "table/combined_interpolation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <set>
#include <span>

#include "case/user_error.h"
#include "numeric/hermite.h"
#include "numeric/lagrange.h"

namespace rheocyte {

namespace {

/// Where a dent appears, the hull's features bend at another deformation in each branch: higher degrees do worse.
constexpr int max_combined_stencil = 4;

/// The interval of ascending nodes that holds x, or the nearest one.
int interval_of(std::span<const double> nodes, double x) {
  const auto above = std::ranges::upper_bound(nodes, x);
  return std::clamp(int(above - nodes.begin()) - 1, 0, std::max(int(nodes.size()) - 2, 0));
}

/// Neighbours of x, as many on both sides as there are, without gaps; the two next ones in any case.
struct Window {
  int first, end;
};

Window window_of(std::span<const double> nodes, double x, const std::function<bool(int)>& is_usable) {
  const int below = interval_of(nodes, x), count = int(nodes.size());
  Window window{below, std::min(below + 2, count)};
  for (bool down = true, up = true; (down || up) && window.end - window.first < max_combined_stencil;) {
    down = down && window.first > 0 && is_usable(window.first - 1);
    if (down) --window.first;
    up = up && window.end < count && is_usable(window.end);
    if (up && window.end - window.first < max_combined_stencil) ++window.end;
  }
  return window;
}

template <class Value>
std::vector<double> distinct(const CombinedTable& table, Value value) {
  std::set<double> numbers;
  for (const auto& branch : table.branches) numbers.insert(value(branch.place));
  return {numbers.begin(), numbers.end()};
}

}  // namespace

/// A weighted sum of states with its derivatives.
struct CombinedInterpolation::Sum {
  Row value = Row::Zero();
  Eigen::Matrix<double, row_count, coordinate_count> gradient =
      Eigen::Matrix<double, row_count, coordinate_count>::Zero();

  void add(const Sum& term, double weight, double weight_slope, CellCoordinate along) {
    value += weight * term.value;
    gradient += weight * term.gradient;
    gradient.col(int(along)) += weight_slope * term.value;
  }
};

// Stiffness, area and modes change with the square root of d to first order; what is left is nearly constant.
CombinedInterpolation::Curve CombinedInterpolation::curve_of(const CombinedBranch& branch) {
  Curve curve;
  const double disc = std::numbers::pi * branch.place.radius_um * branch.place.radius_um;
  for (int i = 0; i < branch.samples(); ++i) {
    const auto value = branch.value.row(i), slope = branch.slope.row(i);
    const double d = value(int(ShapeFeature::deformation)), log_d = std::log(d);
    const double by_stiffness = slope(int(ShapeFeature::deformation)) / d;  // d(ln d)/d(ln S)
    if (by_stiffness >= 0 || (!curve.log_d.empty() && log_d <= curve.log_d.back())) break;
    const double root = std::sqrt(d), area = value(int(ShapeFeature::area_um2));
    Row g, g_slope;
    const auto scaled = [&](int row, double number, double number_slope) {
      g(row) = number / root;
      g_slope(row) = number_slope / (by_stiffness * root) - g(row) / 2;
    };
    g(log_stiffness_row) = std::log(branch.stiffness_kPa[std::size_t(i)]) + log_d / 2;
    g_slope(log_stiffness_row) = 1 / by_stiffness + 0.5;
    scaled(log_area_row, std::log(area / disc), slope(int(ShapeFeature::area_um2)) / area);
    scaled(moment_ratio_row, value(int(ShapeFeature::moment_ratio)) - 1, slope(int(ShapeFeature::moment_ratio)));
    for (int k = 0; k < mode_count; ++k)
      scaled(first_mode_row + k, value(int(ShapeFeature::first_mode) + k), slope(int(ShapeFeature::first_mode) + k));
    curve.log_d.push_back(log_d);
    curve.value.push_back(g);
    curve.slope.push_back(g_slope);
  }
  return curve;
}

CombinedInterpolation::CombinedInterpolation(const CombinedTable& table)
    : radii_(distinct(table, [](const BranchPlace& place) { return place.radius_um; })),
      shares_(distinct(table, [](const BranchPlace& place) { return place.cortex_share; })),
      ratios_(table.spec.tension_ratios) {
  if (radii_.size() < 2 || shares_.size() < 2)
    throw UserError(fmt::format("{}: the combined table has branches of {} radii and {} shares; it needs two of each.",
                                table.spec.identifier, radii_.size(), shares_.size()));
  for (const double radius : radii_) log_radii_.push_back(std::log(radius));
  double least = -1e9, greatest = -1e9;
  for (const double ratio : ratios_)
    for (const double share : shares_)
      for (const double radius : radii_) {
        const auto is_it = [&](const CombinedBranch& branch) {
          const auto& place = branch.place;
          return place.radius_um == radius && place.cortex_share == share &&
                 (place.tension_ratio == ratio || place.cortex_share == 0);
        };
        const auto found = std::ranges::find_if(table.branches, is_it);
        curves_.push_back(found == table.branches.end() ? Curve{} : curve_of(*found));
        if (found != table.branches.end()) curves_.back().branch = int(found - table.branches.begin());
        if (curves_.back().log_d.empty()) continue;
        least = std::max(least, curves_.back().log_d.front());
        greatest = std::max(greatest, curves_.back().log_d.back());
      }
  if (!(least < greatest))
    throw UserError(
        fmt::format("{}: no branch of the combined table has cells that deform the more the softer they are.",
                    table.spec.identifier));
  box_.least << log_radii_.front(), shares_.front(), least, ratios_.front();
  box_.greatest << log_radii_.back(), shares_.back(), greatest, ratios_.back();
}

const CombinedInterpolation::Curve& CombinedInterpolation::curve(int ratio, int share, int radius) const {
  const auto shares = shares_.size(), radii = radii_.size();
  return curves_[(std::size_t(ratio) * shares + std::size_t(share)) * radii + std::size_t(radius)];
}

bool CombinedInterpolation::reaches(int ratio, int share, double log_radius, double log_deformation) const {
  const int below = interval_of(log_radii_, log_radius);
  return curve(ratio, share, below).reaches(log_deformation) && curve(ratio, share, below + 1).reaches(log_deformation);
}

CombinedInterpolation::Sum CombinedInterpolation::over_radii(int ratio, int share, const CellCoordinates& cell) const {
  const double log_d = cell(int(CellCoordinate::log_deformation)), x = cell(int(CellCoordinate::log_radius));
  const auto window = window_of(log_radii_, x, [&](int i) { return curve(ratio, share, i).reaches(log_d); });
  const auto weights = lagrange_weights(
      std::span(log_radii_).subspan(std::size_t(window.first), std::size_t(window.end - window.first)), x);
  Sum sum;
  for (int i = window.first; i < window.end; ++i) {
    const Curve& branch = curve(ratio, share, i);
    if (branch.log_d.empty()) continue;
    Sum term;
    if (branch.log_d.size() < 2 || !branch.reaches(log_d)) {  // straight on from the end
      const bool soft = log_d > branch.log_d.front();
      const auto end = soft ? branch.log_d.size() - 1 : 0;
      term.value = branch.value[end] + (log_d - branch.log_d[end]) * branch.slope[end];
      term.gradient.col(int(CellCoordinate::log_deformation)) = branch.slope[end];
    } else {
      const auto k = std::size_t(interval_of(branch.log_d, log_d));
      const double h = branch.log_d[k + 1] - branch.log_d[k], t = (log_d - branch.log_d[k]) / h;
      const Row &a = branch.value[k], &b = branch.value[k + 1];
      const Row slope_a = h * branch.slope[k], slope_b = h * branch.slope[k + 1];
      term.value = hermite(t)(a, b, slope_a, slope_b);
      term.gradient.col(int(CellCoordinate::log_deformation)) = hermite_slope(t)(a, b, slope_a, slope_b) / h;
    }
    const auto w = std::size_t(i - window.first);
    sum.add(term, weights.value[w], weights.slope[w], CellCoordinate::log_radius);
  }
  return sum;
}

CombinedInterpolation::Sum CombinedInterpolation::over_shares(int ratio, const CellCoordinates& cell) const {
  const double log_d = cell(int(CellCoordinate::log_deformation)), x = cell(int(CellCoordinate::log_radius));
  const double share = cell(int(CellCoordinate::cortex_share));
  const auto window = window_of(shares_, share, [&](int j) { return reaches(ratio, j, x, log_d); });
  const auto weights = lagrange_weights(
      std::span(shares_).subspan(std::size_t(window.first), std::size_t(window.end - window.first)), share);
  Sum sum;
  for (int j = window.first; j < window.end; ++j) {
    const auto w = std::size_t(j - window.first);
    sum.add(over_radii(ratio, j, cell), weights.value[w], weights.slope[w], CellCoordinate::cortex_share);
  }
  return sum;
}

bool CombinedInterpolation::is_inside(const CellCoordinates& cell) const {
  if (!((cell - box_.least).array() >= -1e-12).all() || !((box_.greatest - cell).array() >= -1e-12).all()) return false;
  const double log_d = cell(int(CellCoordinate::log_deformation)), x = cell(int(CellCoordinate::log_radius));
  const int below = interval_of(shares_, cell(int(CellCoordinate::cortex_share)));
  for (int i = 0; i < int(ratios_.size()); ++i)
    if (!reaches(i, below, x, log_d) || !reaches(i, below + 1, x, log_d)) return false;
  return true;
}

std::vector<BranchWeight> CombinedInterpolation::weights(const CellCoordinates& cell) const {
  if (!is_inside(cell)) return {};
  const double log_d = cell(int(CellCoordinate::log_deformation)), x = cell(int(CellCoordinate::log_radius));
  const double share = cell(int(CellCoordinate::cortex_share));
  const auto of_ratios = lagrange_weights(ratios_, cell(int(CellCoordinate::tension_ratio)));
  const auto part = [](const std::vector<double>& nodes, const Window& window) {
    return std::span(nodes).subspan(std::size_t(window.first), std::size_t(window.end - window.first));
  };
  std::vector<BranchWeight> all;
  for (int i = 0; i < int(ratios_.size()); ++i) {
    const auto sheets = window_of(shares_, share, [&](int j) { return reaches(i, j, x, log_d); });
    const auto of_shares = lagrange_weights(part(shares_, sheets), share);
    for (int j = sheets.first; j < sheets.end; ++j) {
      const auto radii = window_of(log_radii_, x, [&](int k) { return curve(i, j, k).reaches(log_d); });
      const auto of_radii = lagrange_weights(part(log_radii_, radii), x);
      for (int k = radii.first; k < radii.end; ++k)
        all.push_back(
            {curve(i, j, k).branch, of_ratios.value[std::size_t(i)] * of_shares.value[std::size_t(j - sheets.first)] *
                                        of_radii.value[std::size_t(k - radii.first)]});
    }
  }
  return all;
}

CombinedState CombinedInterpolation::at(const CellCoordinates& cell) const {
  const double log_d = cell(int(CellCoordinate::log_deformation)), x = cell(int(CellCoordinate::log_radius));
  const auto weights = lagrange_weights(ratios_, cell(int(CellCoordinate::tension_ratio)));
  Sum sum;
  for (int i = 0; i < int(ratios_.size()); ++i) {
    const auto w = std::size_t(i);
    sum.add(over_shares(i, cell), weights.value[w], weights.slope[w], CellCoordinate::tension_ratio);
  }
  // Back from what hardly varies to what is asked for.
  const double root = std::exp(log_d / 2);
  const int by_d = int(CellCoordinate::log_deformation);
  CombinedState state{root * sum.value, root * sum.gradient, is_inside(cell)};
  state.gradient.col(by_d) += state.value / 2;
  state.value(log_stiffness_row) = sum.value(log_stiffness_row) - log_d / 2;
  state.gradient.row(log_stiffness_row) = sum.gradient.row(log_stiffness_row);
  state.gradient(log_stiffness_row, by_d) -= 0.5;
  state.value(log_area_row) += std::log(std::numbers::pi) + 2 * x;
  state.gradient(log_area_row, int(CellCoordinate::log_radius)) += 2;
  state.value(moment_ratio_row) += 1;
  return state;
}

}  // namespace rheocyte

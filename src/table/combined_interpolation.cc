#include "table/combined_interpolation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <set>
#include <span>

#include "case/user_error.h"
#include "numeric/hermite.h"
#include "numeric/no_value.h"

namespace rheocyte {

namespace {

/// Beyond its end a branch goes straight on and counts less and less, over so much of ln of the progress.
constexpr double fading = 0.2;
constexpr double no_branch = -100;  ///< its end

/// What a branch counts that ends there.
CellFunction part_of(const CellFunction& end, double progress) {
  if (progress <= end.value) return {1};
  const double place = std::max((end.value - progress) / fading + 1, 0.);
  return {hermite(place).last, hermite_slope(place).last / fading * (end.gradient - CellCoordinates::Unit(x_progress))};
}

/// Linearly between two functions, at the cell's place between the nodes.
template <class Function>
CellFunction between_nodes(std::span<const double> nodes, const CellCoordinates& cell, int coordinate,
                           const Function& f) {
  const int below = interval_of(nodes, cell(coordinate));
  if (nodes.size() == 1) return f(below);
  const double low = nodes[std::size_t(below)], width = nodes[std::size_t(below) + 1] - low;
  const double inside = std::clamp((cell(coordinate) - low) / width, 0., 1.);
  const CellFunction fraction{inside, CellCoordinates::Unit(coordinate) / width};
  return fraction.complement() * f(below) + fraction * f(below + 1);
}

template <class Value>
std::vector<double> distinct(const CombinedTable& table, Value value) {
  std::set<double> numbers;
  for (const auto& branch : table.branches) numbers.insert(value(branch.place));
  return {numbers.begin(), numbers.end()};
}

}  // namespace

// Stiffness, area and modes change with the square root of d to first order. With a tension along the flow the even
// modes are those that it alone makes, and the flow adds odd ones.
double CombinedInterpolation::growth(int row) const {
  if (row == log_stiffness_row) return is_elongated() ? 1 : 0.5;
  if (!is_elongated()) return row == deformation_row ? 1 : 0.5;
  const bool is_mode = row >= first_mode_row && row < deformation_row;
  return is_mode && order_of_mode(row - first_mode_row + min_mode) == 1 ? 1 : 0;
}

CombinedInterpolation::Curve CombinedInterpolation::curve_of(const CombinedBranch& branch,
                                                             double progress_of_unit) const {
  constexpr int deformation = int(ShapeFeature::deformation);
  const double disc = std::numbers::pi * branch.place.radius_um * branch.place.radius_um;
  Curve curve;
  for (int i = 0; i < branch.samples(); ++i) {
    const auto value = branch.value.row(i), slope = branch.slope.row(i);
    const double stiffness = branch.stiffness_kPa[std::size_t(i)];
    const double flow = is_elongated() ? progress_of_unit / stiffness : value(deformation), place = std::log(flow);
    const double place_slope = is_elongated() ? -1 : slope(deformation) / flow;  // over ln S
    if (!(flow > 0 && place_slope < 0) || (!curve.place.empty() && place <= curve.place.back())) break;
    Row g = Row::Zero(), g_slope = Row::Zero();  // zero in what is padded
    const auto scaled = [&](int row, double number, double number_slope) {
      const double unit = std::pow(flow, growth(row));
      g(row) = number / unit;
      g_slope(row) = number_slope / unit / place_slope - growth(row) * g(row);
    };
    const double area = value(int(ShapeFeature::area_um2));
    g(log_stiffness_row) = std::log(stiffness) + growth(log_stiffness_row) * place;
    g_slope(log_stiffness_row) = 1 / place_slope + growth(log_stiffness_row);
    scaled(log_area_row, std::log(area / disc), slope(int(ShapeFeature::area_um2)) / area);
    scaled(moment_ratio_row, value(int(ShapeFeature::moment_ratio)) - 1, slope(int(ShapeFeature::moment_ratio)));
    for (int k = 0; k < mode_count; ++k)
      scaled(first_mode_row + k, value(int(ShapeFeature::first_mode) + k), slope(int(ShapeFeature::first_mode) + k));
    scaled(deformation_row, value(deformation), slope(deformation));
    curve.place.push_back(place);
    curve.samples.push_back({g, g_slope});
  }
  return curve;
}

namespace {

const CombinedBranch* branch_at(const CombinedTable& table, const SweepPoint& wanted) {
  const auto is_it = [&](const CombinedBranch& branch) {
    const auto& place = branch.place;
    return place.radius_um == wanted.radius_um && place.cortex_fraction == wanted.cortex_fraction &&
           place.axial_ratio == wanted.axial_ratio &&
           (place.tension_ratio == wanted.tension_ratio || place.cortex_fraction == 0);
  };
  const auto found = std::ranges::find_if(table.branches, is_it);
  return found == table.branches.end() ? nullptr : &*found;
}

}  // namespace

double mode_3_of_unit(const CombinedTable& table, SweepPoint place) {
  place.axial_ratio = 0;
  const CombinedBranch* const round = branch_at(table, place);
  return round && round->samples() > 0 ? round->value(0, feature_of_mode(3)) * round->stiffness_kPa[0] : no_value;
}

CombinedInterpolation::Curve CombinedInterpolation::curve_at(const CombinedTable& table,
                                                             const SweepPoint& wanted) const {
  const CombinedBranch* const found = branch_at(table, wanted);
  if (!found) return {};
  Curve curve = curve_of(*found, is_elongated() ? mode_3_of_unit(table, wanted) : no_value);
  curve.branch = int(found - table.branches.data());
  curve.is_own = curve.place.size() > 1;
  return curve;
}

CombinedInterpolation::CombinedInterpolation(const CombinedTable& table)
    : spec_(table.spec),
      radii_(distinct(table, [](const SweepPoint& place) { return place.radius_um; })),
      fractions_(distinct(table, [](const SweepPoint& place) { return place.cortex_fraction; })),
      ratios_(table.spec.tension_ratios),
      axial_ratios_(table.spec.is_elongated() ? table.spec.axial_ratios : std::vector{0.0}) {
  if (radii_.size() < 2)
    throw UserError(fmt::format("{}: the combined table has branches of {} radius; it needs two radii.",
                                table.spec.identifier, radii_.empty() ? "no" : "one"));
  for (const double radius : radii_) log_radii_.push_back(std::log(radius));
  double least = -1e9, greatest = -1e9;
  for (const double axial : axial_ratios_)
    for (const double ratio : ratios_)
      for (const double fraction : fractions_)
        for (const double radius : radii_) {
          const Curve& curve = curves_.emplace_back(curve_at(table, {radius, fraction, ratio, axial}));
          if (!curve.is_own) continue;
          least = std::max(least, curve.place.front());
          greatest = std::max(greatest, curve.place.back());
        }
  if (!(least < greatest))
    throw UserError(
        fmt::format("{}: no branch of the combined table has cells that deform the more the softer they are.",
                    table.spec.identifier));
  fill_gaps();
  box_.least << log_radii_.front(), fractions_.front(), least, ratios_.front(), axial_ratios_.front();
  box_.greatest << log_radii_.back(), fractions_.back(), greatest, ratios_.back(), axial_ratios_.back();
}

// What is scaled hardly varies from branch to branch: where one is missing, which is outside the table, its neighbour
// in radius, else in fraction, leads back in.
void CombinedInterpolation::fill_gaps() {
  const auto radii = radii_.size(), sheet = radii * fractions_.size();
  const auto fill = [&](std::size_t first, std::size_t count, std::size_t stride) {
    for (std::size_t i = 0; i < count; ++i) {
      Curve& gap = curves_[first + i * stride];
      for (std::size_t far = 1; far < count && gap.place.size() < 2; ++far)
        for (const std::size_t k : {i - far, i + far})
          if (k < count && curves_[first + k * stride].is_own) gap = curves_[first + k * stride], gap.is_own = false;
    }
  };
  for (std::size_t row = 0; row < curves_.size(); row += radii) fill(row, radii, 1);
  for (std::size_t column = 0; column < curves_.size(); ++column)
    if (column % sheet < radii) fill(column, fractions_.size(), radii);
}

const CombinedInterpolation::Curve& CombinedInterpolation::curve(int sheet, int fraction, int radius) const {
  const auto fractions = fractions_.size(), radii = radii_.size();
  return curves_[(std::size_t(sheet) * fractions + std::size_t(fraction)) * radii + std::size_t(radius)];
}

bool CombinedInterpolation::reaches(int sheet, int fraction, const CellCoordinates& cell) const {
  const double progress = cell(x_progress);
  const int below = interval_of(log_radii_, cell(x_radius));
  return curve(sheet, fraction, below).reaches(progress) && curve(sheet, fraction, below + 1).reaches(progress);
}

bool CombinedInterpolation::sheet_reaches(int sheet, const CellCoordinates& cell) const {
  const int below = interval_of(fractions_, cell(x_fraction));
  return reaches(sheet, below, cell) && (fractions_.size() == 1 || reaches(sheet, below + 1, cell));
}

bool CombinedInterpolation::axial_reaches(int axial, const CellCoordinates& cell) const {
  const int below = interval_of(ratios_, cell(x_ratio));
  return sheet_reaches(sheet_of(axial, below), cell) &&
         (ratios_.size() == 1 || sheet_reaches(sheet_of(axial, below + 1), cell));
}

CellFunction CombinedInterpolation::end(const Curve& branch) const {
  return {branch.is_own ? branch.place.back() : no_branch};
}

CellFunction CombinedInterpolation::end(int sheet, int fraction, const CellCoordinates& cell) const {
  return between_nodes(log_radii_, cell, x_radius, [&](int i) { return end(curve(sheet, fraction, i)); });
}

CellFunction CombinedInterpolation::sheet_end(int sheet, const CellCoordinates& cell) const {
  return between_nodes(fractions_, cell, x_fraction, [&](int j) { return end(sheet, j, cell); });
}

CellFunction CombinedInterpolation::axial_end(int axial, const CellCoordinates& cell) const {
  return between_nodes(ratios_, cell, x_ratio, [&](int i) { return sheet_end(sheet_of(axial, i), cell); });
}

CombinedInterpolation::CurveWeights CombinedInterpolation::curve_weights(const CellCoordinates& cell) const {
  const double progress = cell(x_progress);
  const AxisPolynomials by_axial(axial_ratios_, cell, x_axial), by_ratio(ratios_, cell, x_ratio),
      by_fraction(fractions_, cell, x_fraction), by_radius(log_radii_, cell, x_radius);
  CurveWeights weights{{}, HUGE_VAL};
  auto& all = weights.all;
  all.reserve(by_axial.usual_nodes() * by_ratio.usual_nodes() * by_fraction.usual_nodes() * by_radius.usual_nodes());
  const auto part_until = [&](const CellFunction& end) {
    weights.last_progress = std::min(weights.last_progress, end.value);
    return part_of(end, progress);
  };
  const auto add_radii = [&](int sheet, int fraction, const CellFunction& of_row) {
    const auto part = [&](int i) { return part_until(end(curve(sheet, fraction, i))); };
    std::optional<AxisPolynomials::Weights> parts;
    for (const auto& [radius, of_radius] : by_radius.weights(part, parts))
      if (const Curve& found = curve(sheet, fraction, radius); !found.place.empty())
        all.push_back({&found, of_row * of_radius});
  };
  const auto add_sheet = [&](int sheet, const CellFunction& of_sheet) {
    const auto part = [&](int j) { return part_until(end(sheet, j, cell)); };
    std::optional<AxisPolynomials::Weights> parts;
    for (const auto& [fraction, of_fraction] : by_fraction.weights(part, parts))
      add_radii(sheet, fraction, of_sheet * of_fraction);
  };
  const auto add_axial = [&](int axial, const CellFunction& of_axial) {
    const auto part = [&](int i) { return part_until(sheet_end(sheet_of(axial, i), cell)); };
    std::optional<AxisPolynomials::Weights> parts;
    for (const auto& [ratio, of_ratio] : by_ratio.weights(part, parts))
      add_sheet(sheet_of(axial, ratio), of_axial * of_ratio);
  };
  const auto part = [&](int i) { return part_until(axial_end(i, cell)); };
  std::optional<AxisPolynomials::Weights> parts;
  for (const auto& [axial, of_axial] : by_axial.weights(part, parts)) add_axial(axial, of_axial);
  return weights;
}

bool CombinedInterpolation::is_inside(const CellCoordinates& cell) const {
  if (!((cell - box_.least).array() >= -1e-12).all() || !((box_.greatest - cell).array() >= -1e-12).all()) return false;
  const int below = interval_of(axial_ratios_, cell(x_axial));
  return axial_reaches(below, cell) && (!is_elongated() || axial_reaches(below + 1, cell));
}

CellCoordinates CombinedInterpolation::nearest_inside(CellCoordinates cell) const {
  constexpr int halvings = 30;
  cell = cell.cwiseMax(box_.least).cwiseMin(box_.greatest);
  if (is_inside(cell)) return cell;
  double inside = box_.least(x_progress), beyond = cell(x_progress);
  for (int i = 0; i < halvings; ++i) {
    cell(x_progress) = (inside + beyond) / 2;
    (is_inside(cell) ? inside : beyond) = cell(x_progress);
  }
  cell(x_progress) = inside;
  return cell;
}

}  // namespace rheocyte

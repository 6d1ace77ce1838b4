#include "table/grid_from_branches.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "numeric/lagrange.h"
#include "table/branch_border.h"
#include "table/origin_record.h"
#include "table/shapes_from_branches.h"
#include "table/table_metadata.h"

namespace rheocyte {

namespace {

constexpr int max_grid_stencil = 6;
constexpr double min_height = 0.02;     // of a column, in ln(deformation)
constexpr double trusted_error = 1e-3;  // of nodes along the border; beyond it other ways are looked at, too
constexpr int near_branches = 10;       // on each side, among which a column finds its neighbours

/// One crossing of a line of equal height with a branch.
struct Crossing {
  double log_area, log_deformation, log_stiffness, error;
};

/// What the polynomials through the crossings of one line are at a column.
struct NodeValue {
  double log_deformation, log_stiffness, error;
};

// Between the crossings, or at most half their distance beyond them.
std::optional<NodeValue> value_at(std::span<const Crossing> line, double log_area) {
  const auto size = static_cast<std::ptrdiff_t>(line.size());
  if (size < 2) return {};
  const auto behind = std::ranges::upper_bound(line, log_area, {}, &Crossing::log_area) - line.begin();
  const auto below = std::clamp<std::ptrdiff_t>(behind - 1, 0, size - 2);
  const auto &a = line[static_cast<std::size_t>(below)], &b = line[static_cast<std::size_t>(below) + 1];
  const double slack = 0.5 * (b.log_area - a.log_area);
  if (log_area < a.log_area - slack || log_area > b.log_area + slack) return {};
  const auto count = std::min<std::ptrdiff_t>(max_grid_stencil, size);
  const auto first = std::clamp<std::ptrdiff_t>(below - count / 2 + 1, 0, size - count);
  const auto nodes = line.subspan(static_cast<std::size_t>(first), static_cast<std::size_t>(count));
  const auto at_column = [&](double Crossing::*member) {
    return lagrange_estimate(nodes, log_area, &Crossing::log_area, member);
  };
  const auto value = at_column(&Crossing::log_stiffness), height = at_column(&Crossing::log_deformation);
  // A deformation that is off counts half, because d ~ E^-2.
  return NodeValue{height.value, value.value,
                   std::max(a.error, b.error) + std::abs(value.change + 0.5 * height.change)};
}

// The value of a column at a height. A line of equal height bends with the border, more than the branches resolve; its
// polynomials miss its height by as much as its value, so that value and height together are right. Nothing if the
// border is so jagged that the heights of the lines do not follow one another.
std::optional<NodeValue> resampled(std::span<const NodeValue> column, std::size_t row, double log_deformation,
                                   double distance) {
  constexpr std::size_t points = 4;
  const std::size_t count = std::min(points, column.size());
  const std::size_t first = std::min(row > 1 ? row - 1 : 0, column.size() - count);
  const auto nodes = column.subspan(first, count);
  for (std::size_t k = 1; k < count; ++k)
    if (!(nodes[k].log_deformation - nodes[k - 1].log_deformation > 0.5 * distance)) return {};
  return NodeValue{log_deformation,
                   lagrange_value(nodes, log_deformation, &NodeValue::log_deformation, &NodeValue::log_stiffness),
                   column[row].error};
}

/// One family of branches on its way to a patch.
class PatchMaker {
 public:
  PatchMaker(std::vector<LogBranch> branches, const Columns& columns)
      : branches_(std::move(branches)), columns_(columns) {}

  /// In the columns [from, to).
  std::optional<GridPatch> patch(const std::vector<double>& lower, const Border& upper, int rows, int from,
                                 int to) const {
    const auto count = static_cast<std::size_t>(columns_.count);
    std::vector<std::vector<NodeValue>> lines(count), values(count);  // by column
    for (int row = 0; row < rows; ++row) {
      const auto line = crossings(lower, upper.height, static_cast<double>(row) / (rows - 1));
      for (std::size_t c = 0; c < count; ++c)
        if (const auto value = value_at(line, columns_.at(static_cast<double>(c)))) lines[c].push_back(*value);
    }
    for (auto c = static_cast<std::size_t>(from); c < static_cast<std::size_t>(to); ++c)
      if (upper.height[c] - lower[c] >= min_height)
        values[c] = column_of(c, lines[c], {lower[c], upper.height[c]}, rows);
    const auto is_whole = [&](std::size_t c) { return values[c].size() == static_cast<std::size_t>(rows); };
    const auto [first, end] = longest_run(count, is_whole);
    if (end - first < 2) return {};
    GridPatch patch;
    patch.first_column = static_cast<int>(first);
    patch.columns = static_cast<int>(end - first);
    patch.rows = rows;
    for (std::size_t c = first; c < end; ++c) {
      patch.lower.push_back(lower[c]);
      patch.upper.push_back(upper.height[c]);
      patch.beyond.push_back(static_cast<double>(upper.beyond[c]));
      for (const NodeValue& node : values[c]) {
        patch.log_stiffness.push_back(node.log_stiffness);
        patch.error.push_back(node.error);
      }
    }
    return patch;
  }

 private:
  struct Range {
    double lower, upper;
  };

  // The nodes of a column: along the lines of equal height or, where these are not to be trusted, at constant
  // deformation, whichever has the smaller error. Not all of them if some have no value.
  std::vector<NodeValue> column_of(std::size_t c, std::span<const NodeValue> lines, const Range& range,
                                   int rows) const {
    std::vector<NodeValue> nodes;
    const double distance = (range.upper - range.lower) / (rows - 1);
    for (int row = 0; row < rows; ++row) {
      const double height = range.lower + row * distance;
      std::optional<NodeValue> node;
      if (lines.size() == static_cast<std::size_t>(rows))
        node = resampled(lines, static_cast<std::size_t>(row), height, distance);
      if (!node || node->error > trusted_error) {
        const auto other = at_deformation(columns_.at(static_cast<double>(c)), height);
        if (other && (!node || other->error < node->error)) node = other;
      }
      if (!node) break;
      nodes.push_back(*node);
    }
    return nodes;
  }

  // From the branches next to an area that have this deformation.
  std::optional<NodeValue> at_deformation(double log_area, double log_deformation) const {
    const auto above = std::ranges::upper_bound(branches_, log_area, {},
                                                [](const LogBranch& branch) { return branch.first().log_area; });
    const auto middle = above - branches_.begin(), size = std::ssize(branches_);
    const auto first = std::max<std::ptrdiff_t>(middle - near_branches, 0),
               end = std::min<std::ptrdiff_t>(middle + near_branches, size);
    const auto near =
        std::span(branches_).subspan(static_cast<std::size_t>(first), static_cast<std::size_t>(end - first));
    return value_at(crossings(near, [&](const LogBranch::Point& p) { return p.log_deformation - log_deformation; }),
                    log_area);
  }

  // Heights between and, in straight lines, beyond the columns.
  double height(const std::vector<double>& border, double log_area) const {
    const double place = (log_area - columns_.first) / columns_.step;
    const int column = std::clamp(static_cast<int>(std::floor(place)), 0, columns_.count - 2);
    const double a = border[static_cast<std::size_t>(column)], b = border[static_cast<std::size_t>(column) + 1];
    return a + (place - column) * (b - a);
  }

  std::vector<Crossing> crossings(const std::vector<double>& lower, const std::vector<double>& upper,
                                  double fraction) const {
    return crossings(std::span(branches_), [&](const LogBranch::Point& p) {
      return p.log_deformation - (1 - fraction) * height(lower, p.log_area) - fraction * height(upper, p.log_area);
    });
  }

  template <class Height>
  static std::vector<Crossing> crossings(std::span<const LogBranch> branches, const Height& height) {
    std::vector<Crossing> line;
    for (const auto& branch : branches) {
      const double log_stiffness = branch.crossing(height);
      if (!std::isfinite(log_stiffness)) continue;
      const auto& own = branch.branch();
      const double stiffness = std::clamp(std::exp(log_stiffness), own.stiffness.back(), own.stiffness.front());
      const auto point = branch.at(log_stiffness);
      line.push_back({point.log_area, point.log_deformation, log_stiffness, stiffness_error(point_at(own, stiffness))});
    }
    std::ranges::sort(line, {}, &Crossing::log_area);
    return line;
  }

  template <class Condition>
  static std::pair<std::size_t, std::size_t> longest_run(std::size_t count, const Condition& holds) {
    std::size_t first = 0, end = 0;
    for (std::size_t start = 0; start < count;) {
      std::size_t stop = start;
      while (stop < count && holds(stop)) ++stop;
      if (stop - start > end - first) first = start, end = stop;
      start = stop + 1;
    }
    return {first, end};
  }

  std::vector<LogBranch> branches_;
  Columns columns_;
};

// Bending makes cells stiffer: moduli drop by some percent where it takes over, and no one knows the bending of a cell.
void add_step_to_error(const GridPatch& bare, GridPatch& regularised) {
  for (int c = 0; c < regularised.columns; ++c) {
    const int under = regularised.first_column + c - bare.first_column;
    if (under < 0 || under >= bare.columns) continue;
    const double below = bare.log_stiffness[static_cast<std::size_t>((under + 1) * bare.rows - 1)];
    const auto column = static_cast<std::size_t>(c * regularised.rows);
    const double step = std::abs(regularised.log_stiffness[column] - below);
    for (std::size_t row = 0; row < static_cast<std::size_t>(regularised.rows); ++row)
      regularised.error[column + row] += step;
  }
}

// Errors are known to two digits, moduli to nine at best. Bits beyond would be noise, which fills half of a compressed
// grid.
double error_in_few_bits(double error) {
  constexpr int bits = 8;
  int exponent = 0;
  const double mantissa = std::frexp(error, &exponent);
  return std::ldexp(std::ceil(std::ldexp(mantissa, bits)), exponent - bits);
}

double logarithm_in_few_bits(double log_stiffness) {
  constexpr double unit = 0x1p-30;
  return std::round(log_stiffness / unit) * unit;
}

// To the columns that the bare branches cover.
void trim_to(GridContent& grid, const GridPatch& bare) {
  grid.min_log_area += bare.first_column * grid.column_step;
  grid.columns = bare.columns;
}

}  // namespace

std::optional<GridContent> make_stiffness_grid(const TableSpec& spec, std::span<const SampledBranch> branches,
                                               std::string_view version, const GridResolution& resolution) {
  std::vector<LogBranch> own, regularised;
  for (const auto& radius : by_radius(branches)) {
    if (radius.bare() && radius.bare()->samples() > 1) own.emplace_back(*radius.bare());
    if (radius.regularised() && radius.regularised()->samples() > 1) regularised.emplace_back(*radius.regularised());
  }
  if (own.size() < 2) return {};
  const double first = std::log(spec.min_area_um2), last = std::log(spec.max_area_um2);
  const Columns columns{first, (last - first) / (resolution.columns - 1), resolution.columns};
  const Border border = upper_border(own, spec, columns);
  const std::vector<double> least(static_cast<std::size_t>(columns.count), std::log(spec.min_deformation));
  const auto bare = PatchMaker(own, columns).patch(least, border, resolution.rows, 0, columns.count);
  if (!bare) return {};
  GridContent grid{origin_of(spec, version), columns.first, columns.step, columns.count, {*bare}};
  if (spec.wants_regularised() && regularised.size() > 1) {
    auto above = PatchMaker(regularised, columns)
                     .patch(border.height, upper_border(regularised, spec, columns), resolution.regularised_rows,
                            bare->first_column, bare->first_column + bare->columns);
    if (above) {
      above->regularised = true;
      add_step_to_error(*bare, *above);
      grid.patches.push_back(std::move(*above));
    }
  }
  const int shift = bare->first_column;
  trim_to(grid, *bare);
  for (auto& patch : grid.patches) {
    patch.first_column -= shift;
    std::ranges::transform(patch.error, patch.error.begin(), error_in_few_bits);
    std::ranges::transform(patch.log_stiffness, patch.log_stiffness.begin(), logarithm_in_few_bits);
  }
  grid.shapes = shapes_from_branches(grid, branches);
  return grid;
}

}  // namespace rheocyte

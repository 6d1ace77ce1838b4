#include "infer/cells_under_tension.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "measurement/pixel_errors.h"
#include "numeric/lagrange.h"
#include "table/origin_record.h"

namespace rheocyte {
namespace {

constexpr int columns = 80, rows = 48;
constexpr int places = 32;            ///< along a line of equal area
constexpr double least_height = 0.5;  ///< of a column, in ln(deformation)
constexpr std::size_t points_around = 4;

/// Of a line of cells with one area under one tension, from stiff to soft.
struct LinePoint {
  double log_deformation, log_modulus, log_stiffness;
  CellCoordinates cell;
};
using Line = std::vector<LinePoint>;

class TensionedCells {
 public:
  TensionedCells(const ProportionedCells& cells, const Sight& sight, double tension_Pa)
      : cells_(cells),
        box_(cells.table().box()),
        sight_(sight),
        tension_kPa_(tension_Pa / 1e3 / scale_factors(cells.simulated(), sight.flow).modulus) {
    // As it would be seen in the table's channel.
    const double exponent = sight.flow.exponent;
    sight_.flow = cells.simulated();
    sight_.flow.exponent = exponent;
  }

  /// Soft cells are longer and have larger areas.
  std::pair<double, double> log_areas() const {
    return {log_area_at(box_.least(x_radius)), log_area_at(box_.greatest(x_radius)) + most_growth};
  }

  /// Empty beyond the table; up to its last cell, or that from which on softer cells are less deformed.
  Line line(double log_area) const {
    Line points;
    CellCoordinates cell = stiffest();
    const double first = box_.least(x_progress), last = box_.greatest(x_progress), step = (last - first) / (places - 1);
    double inside = first;
    for (int k = 0; k < places; ++k) {
      const auto point = point_at(first + k * step, log_area, cell);
      if (!point && points.empty()) continue;  // stiff cells of this area are larger than those of the table
      if (!point) break;
      if (!points.empty() && point->log_deformation <= points.back().log_deformation) return points;
      points.push_back(*point);
      inside = first + k * step;
    }
    if (!points.empty() && inside < last) add_end(log_area, {inside, inside + step}, cell, points);
    return points;
  }

 private:
  CellCoordinates stiffest() const {
    CellCoordinates cell = box_.least;
    cell(x_radius) = (box_.least(x_radius) + box_.greatest(x_radius)) / 2;
    cell(x_axial) = 0;
    return cell;
  }

  static constexpr double most_growth = 0.25;  ///< of ln(area) by elongation

  double log_area_at(double log_radius) const {
    CellCoordinates cell = stiffest();
    cell(x_radius) = log_radius;
    return cells_.table().at(cell).value(log_area_row);
  }

  /// Between the last place inside the table and the first one beyond.
  void add_end(double log_area, std::pair<double, double> between, CellCoordinates cell, Line& points) const {
    constexpr int halvings = 12;
    auto [inside, beyond] = between;
    std::optional<LinePoint> end;
    for (int i = 0; i < halvings; ++i) {
      const double middle = (inside + beyond) / 2;
      const auto point = point_at(middle, log_area, cell);
      if (point) end = point;
      (point ? inside : beyond) = middle;
    }
    if (end && end->log_deformation > points.back().log_deformation) points.push_back(*end);
  }

  /// The cell with this progress and area under the tension, from a cell near it on, which becomes this one; nothing
  /// beyond the table.
  std::optional<LinePoint> point_at(double progress, double log_area, CellCoordinates& near) const {
    constexpr int most_steps = 20;
    constexpr double accuracy = 1e-9;
    CellCoordinates cell = near;
    cell(x_progress) = progress;
    const ShapeVector added = cells_.change_by_section(cell, sight_);  // hardly changes on the way
    for (int step = 0; step < most_steps; ++step) {
      const CombinedState state = cells_.table().at(cell);
      const double axial = tension_kPa_ * std::exp(-state.value(log_stiffness_row));
      const Eigen::Vector2d off(state.value(log_area_row) + added(int(ShapeFeature::area_um2)) - log_area,
                                cell(x_axial) - axial);
      Eigen::Matrix2d slopes;
      slopes.row(0) << state.gradient(log_area_row, x_radius), state.gradient(log_area_row, x_axial);
      slopes.row(1) << axial * state.gradient(log_stiffness_row, x_radius),
          1 + axial * state.gradient(log_stiffness_row, x_axial);
      const Eigen::Vector2d change = slopes.inverse() * off;
      cell(x_radius) -= change(0), cell(x_axial) -= change(1);
      if (!cell.allFinite()) return {};
      if (change.norm() > accuracy) continue;
      if (!cells_.table().is_inside(cell)) return {};
      near = cell;
      const double deformation =
          state.value(deformation_row) + cells_.change_by_section(cell, sight_)(int(ShapeFeature::deformation));
      return LinePoint{std::log(std::max(deformation, std::numeric_limits<double>::min())),
                       std::log(cells_.effective_modulus_kPa(cell)), state.value(log_stiffness_row), cell};
    }
    return {};
  }

  const ProportionedCells& cells_;
  const CellBox& box_;
  Sight sight_;
  double tension_kPa_;  ///< in the table's flow
};

struct RowValue {
  double log_modulus, slope;  ///< the latter over ln(deformation)
};

/// Of one of the numbers at rows of equal distance between the ends of a line.
std::vector<RowValue> values_at_rows(const Line& line, double LinePoint::*number) {
  std::vector<RowValue> values;
  const double first = line.front().log_deformation, last = line.back().log_deformation;
  for (int row = 0; row < rows; ++row) {
    const double height = first + (last - first) * row / (rows - 1);
    const auto behind = std::ranges::upper_bound(line, height, {}, &LinePoint::log_deformation) - line.begin();
    const auto start = std::clamp<std::ptrdiff_t>(behind - std::ptrdiff_t(points_around / 2), 0,
                                                  std::ssize(line) - std::ptrdiff_t(points_around));
    const auto around = std::span(line).subspan(std::size_t(start), points_around);
    const LinePoint &a = around[1], &b = around[2];
    values.push_back({lagrange_value(around, height, &LinePoint::log_deformation, number),
                      (b.*number - a.*number) / (b.log_deformation - a.log_deformation)});
  }
  return values;
}

/// What pixels add to the deformations of a line's cells beyond the law of the pixels, at some of its cells and linear
/// between them.
class PixelsBeyondLaw {
 public:
  PixelsBeyondLaw(const ProportionedCells& cells, const Sight& sight, double pixel_size_um)
      : cells_(cells), sight_(sight), pixel_size_um_(pixel_size_um) {}

  /// At cells from stiff to soft.
  std::vector<double> at_nodes(const Line& line) const {
    std::vector<double> excess;
    for (int k = 0; k < nodes; ++k) excess.push_back(of(line[std::size_t(k) * (line.size() - 1) / (nodes - 1)].cell));
    return excess;
  }

  /// Shifts the deformations of a line whose cells have these.
  static void add(const std::vector<double>& at_nodes, Line& line) {
    for (std::size_t i = 0; i < line.size(); ++i) {
      const double place = double(i) / double(line.size() - 1) * (nodes - 1);
      const auto before = std::min(std::size_t(place), std::size_t(nodes - 2));
      const double excess = std::lerp(at_nodes[before], at_nodes[before + 1], place - double(before));
      const double deformation = std::exp(line[i].log_deformation);
      line[i].log_deformation += std::log1p(excess * std::min(1 / deformation, 1 / elongated));
    }
  }

 private:
  static constexpr int nodes = 6;
  /// Below this deformation cells are about round, and the excess is that in proportion.
  static constexpr double elongated = 0.02;

  double of(const CellCoordinates& cell) const {
    const ShapeVector smooth = cells_.smooth_shape(cell, sight_),
                      by_pixels = cells_.mean_of_pixels(smooth, pixel_size_um_), seen = smooth + by_pixels;
    const double log_area_px = seen(int(ShapeFeature::area_um2)) - 2 * std::log(pixel_size_um_);
    const PixelErrors by_law = pixel_errors(log_area_px, seen(int(ShapeFeature::deformation)));
    return by_pixels(int(ShapeFeature::deformation)) - by_law.deformation_excess;
  }

  const ProportionedCells& cells_;
  const Sight& sight_;
  double pixel_size_um_;
};

bool is_long(const Line& line) {
  return line.size() >= points_around && line.back().log_deformation - line.front().log_deformation > least_height;
}

/// Shifts the lines by what pixels add beyond the law at some of them, linear between these.
void add_pixels_beyond_law(const PixelsBeyondLaw& pixels, std::span<Line> lines) {
  constexpr std::size_t stretches = 4;
  const auto begin_of = [&](std::size_t stretch) { return stretch * (lines.size() - 1) / stretches; };
  std::vector<std::vector<double>> at_lines;
  for (std::size_t k = 0; k <= stretches; ++k) at_lines.push_back(pixels.at_nodes(lines[begin_of(k)]));
  std::size_t stretch = 0;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    while (stretch + 1 < stretches && i >= begin_of(stretch + 1)) ++stretch;
    const std::size_t begin = begin_of(stretch), end = begin_of(stretch + 1);
    const double place = end > begin ? double(i - begin) / double(end - begin) : 0;
    std::vector<double> excess;
    for (std::size_t node = 0; node < at_lines.front().size(); ++node)
      excess.push_back(std::lerp(at_lines[stretch][node], at_lines[stretch + 1][node], place));
    PixelsBeyondLaw::add(excess, lines[i]);
  }
}

/// The first lines that are long, and none beyond the first one that is not again.
std::span<Line> long_ones(std::vector<Line>& lines) {
  const auto first = std::ranges::find_if(lines, is_long);
  return {first, std::find_if_not(first, lines.end(), is_long)};
}

/// The column of a number on a line of cells.
void add_column(const Line& line, double LinePoint::*number, double accuracy, GridPatch& patch) {
  patch.lower.push_back(line.front().log_deformation);
  patch.upper.push_back(line.back().log_deformation);
  patch.beyond.push_back(double(OutOfTable::too_soft));
  for (const auto& [value, slope] : values_at_rows(line, number)) {
    patch.log_stiffness.push_back(value);
    patch.error.push_back(accuracy * std::max(std::abs(slope), 1.0));  // that of the deformation
  }
}

}  // namespace

std::optional<GridsUnderTension> grids_under_tension(const ProportionedCells& cells, const Sight& sight,
                                                     double tension_Pa, double pixel_size_um) {
  const TensionedCells tensioned(cells, sight, tension_Pa);
  GridContent grid;
  grid.origin = origin_of(cells.table().spec(), {});
  grid.origin.is_shell = false;  // the modulus is that of a solid
  const auto [smallest, largest] = tensioned.log_areas();
  grid.min_log_area = smallest;
  grid.columns = columns;
  grid.column_step = (largest - smallest) / (columns - 1);
  std::vector<Line> all;
  for (int column = 0; column < columns; ++column) all.push_back(tensioned.line(smallest + column * grid.column_step));
  const std::span<Line> lines = long_ones(all);
  if (lines.size() < 2) return {};
  if (pixel_size_um > 0) add_pixels_beyond_law({cells, sight, pixel_size_um}, lines);
  GridPatch moduli;
  moduli.rows = rows;
  moduli.first_column = int(lines.data() - all.data());
  moduli.columns = int(lines.size());
  GridPatch stiffnesses = moduli;
  for (const Line& line : lines) {
    add_column(line, &LinePoint::log_modulus, cells.table().spec().accuracy, moduli);
    add_column(line, &LinePoint::log_stiffness, cells.table().spec().accuracy, stiffnesses);
  }
  GridsUnderTension grids{grid, grid};
  grids.effective_modulus.patches.push_back(std::move(moduli));
  grids.stiffness.patches.push_back(std::move(stiffnesses));
  return grids;
}

std::optional<GridContent> grid_under_tension(const ProportionedCells& cells, const Sight& sight, double tension_Pa,
                                              double pixel_size_um) {
  auto grids = grids_under_tension(cells, sight, tension_Pa, pixel_size_um);
  if (!grids) return {};
  return std::move(grids->effective_modulus);
}

}  // namespace rheocyte

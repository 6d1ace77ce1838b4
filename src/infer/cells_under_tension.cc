#include "infer/cells_under_tension.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "numeric/lagrange.h"
#include "table/origin_record.h"

namespace rheocyte {
namespace {

constexpr int columns = 96, rows = 48;
constexpr int places = 48;            ///< along a line of equal area
constexpr double least_height = 0.5;  ///< of a column, in ln(deformation)
constexpr std::size_t points_around = 4;

/// Of a line of cells with one area under one tension, from stiff to soft.
struct LinePoint {
  double log_deformation, log_modulus, log_stiffness;
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
                       std::log(cells_.effective_modulus_kPa(cell)), state.value(log_stiffness_row)};
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

bool is_long(const Line& line) {
  return line.size() >= points_around && line.back().log_deformation - line.front().log_deformation > least_height;
}

/// The column of a number on a line of cells.
void add_column(const Line& line, double LinePoint::*number, double accuracy, GridPatch& patch) {
  ++patch.columns;
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
                                                     double tension_Pa) {
  const TensionedCells tensioned(cells, sight, tension_Pa);
  GridContent grid;
  grid.origin = origin_of(cells.table().spec(), {});
  grid.origin.is_shell = false;  // the modulus is that of a solid
  const auto [smallest, largest] = tensioned.log_areas();
  grid.min_log_area = smallest;
  grid.columns = columns;
  grid.column_step = (largest - smallest) / (columns - 1);
  GridPatch moduli;
  moduli.rows = rows;
  GridPatch stiffnesses = moduli;
  for (int column = 0; column < columns; ++column) {
    const Line line = tensioned.line(grid.min_log_area + column * grid.column_step);
    if (!is_long(line)) {
      if (moduli.columns > 0) break;
      moduli.first_column = stiffnesses.first_column = column + 1;
      continue;
    }
    add_column(line, &LinePoint::log_modulus, cells.table().spec().accuracy, moduli);
    add_column(line, &LinePoint::log_stiffness, cells.table().spec().accuracy, stiffnesses);
  }
  if (moduli.columns < 2) return {};
  GridsUnderTension grids{grid, grid};
  grids.effective_modulus.patches.push_back(std::move(moduli));
  grids.stiffness.patches.push_back(std::move(stiffnesses));
  return grids;
}

std::optional<GridContent> grid_under_tension(const ProportionedCells& cells, const Sight& sight, double tension_Pa) {
  auto grids = grids_under_tension(cells, sight, tension_Pa);
  if (!grids) return {};
  return std::move(grids->effective_modulus);
}

}  // namespace rheocyte

#include "table/stiffness_grid.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "numeric/hermite.h"
#include "numeric/no_value.h"
#include "table/node_slopes.h"

namespace rheocyte {

namespace {}  // namespace

StiffnessGrid::Patch StiffnessGrid::ready(const GridPatch& patch) {
  Patch made{patch.regularised, patch.first_column, patch.columns, patch.rows, {}, {}, {}, {}, {}};
  const auto rows = static_cast<std::size_t>(patch.rows), columns = static_cast<std::size_t>(patch.columns);
  const auto& values = patch.log_stiffness;
  assert(values.size() == rows * columns && patch.error.size() == values.size());
  const auto by_row = slopes_by_row(values, rows), by_column = slopes_by_column(values, rows),
             by_both = slopes_by_column(by_row, rows);
  for (std::size_t i = 0; i < values.size(); ++i)
    made.nodes.push_back({values[i], by_column[i], by_row[i], by_both[i]});
  const auto lower = node_slopes(patch.lower), upper = node_slopes(patch.upper);
  for (std::size_t c = 0; c < columns; ++c) {
    made.lower.push_back({patch.lower[c], lower[c]});
    made.upper.push_back({patch.upper[c], upper[c]});
    made.beyond.push_back(static_cast<NoAnswer>(static_cast<int>(patch.beyond[c])));
  }
  made.cell_error.assign(values.size(), 0);
  for (std::size_t c = 0; c + 1 < columns; ++c)
    for (std::size_t row = 0; row + 1 < rows; ++row) {
      const std::size_t i = c * rows + row;
      made.cell_error[i] =
          std::max({patch.error[i], patch.error[i + 1], patch.error[i + rows], patch.error[i + rows + 1]});
    }
  return made;
}

StiffnessGrid::StiffnessGrid(GridContent content) : content_(std::move(content)) {
  for (const auto& patch : content_.patches) patches_.push_back(ready(patch));
}

/// A place between two columns of a patch.
struct StiffnessGrid::Place {
  std::size_t column;
  HermiteWeights weight, change;
  double lower, upper;

  double edge(const std::vector<Edge>& e, const HermiteWeights& w) const {
    return w(e[column].value, e[column + 1].value, e[column].by_column, e[column + 1].by_column);
  }
};

GridAnswer StiffnessGrid::between(const Patch& patch, const Place& place, double log_deformation) const {
  const double rows_per_height = (patch.rows - 1) / (place.upper - place.lower);
  const double height = (log_deformation - place.lower) * rows_per_height;
  const int row = std::min(static_cast<int>(height), patch.rows - 2);
  const HermiteWeights up = hermite(height - row), up_change = hermite_slope(height - row);
  const std::size_t first = place.column * static_cast<std::size_t>(patch.rows) + static_cast<std::size_t>(row);
  const Node *const a = &patch.nodes[first], *const b = a + patch.rows;
  const auto along = [](const HermiteWeights& w, const Node* n) {
    return w(n[0].value, n[1].value, n[0].by_row, n[1].by_row);
  };
  const auto across = [](const HermiteWeights& w, const Node* n) {
    return w(n[0].by_column, n[1].by_column, n[0].by_both, n[1].by_both);
  };
  const double value_a = along(up, a), value_b = along(up, b), slope_a = across(up, a), slope_b = across(up, b);
  const double by_row =
      place.weight(along(up_change, a), along(up_change, b), across(up_change, a), across(up_change, b));
  // At constant deformation the height in rows changes with the borders.
  const double lower_change = place.edge(patch.lower, place.change),
               upper_change = place.edge(patch.upper, place.change);
  const double height_change =
      -lower_change * rows_per_height - height * (upper_change - lower_change) / (place.upper - place.lower);
  return {place.weight(value_a, value_b, slope_a, slope_b),
          (place.change(value_a, value_b, slope_a, slope_b) + by_row * height_change) / content_.column_step,
          by_row * rows_per_height,
          patch.cell_error[first],
          NoAnswer::none,
          patch.regularised};
}

GridAnswer StiffnessGrid::answer_at(double log_area, double log_deformation) const {
  const auto none = [](NoAnswer reason) { return GridAnswer{no_value, no_value, no_value, no_value, reason, false}; };
  const double place = (log_area - content_.min_log_area) / content_.column_step;
  if (std::isnan(place) || std::isnan(log_deformation)) return none(NoAnswer::invalid);
  if (place < 0) return none(NoAnswer::too_small);
  if (place > content_.columns - 1) return none(NoAnswer::too_large);
  const int column = std::min(static_cast<int>(place), content_.columns - 2);
  const double share = place - column;
  Place here{0, hermite(share), hermite_slope(share), 0, 0};
  NoAnswer reason = NoAnswer::too_stiff;
  for (const Patch& patch : patches_) {
    const int in_patch = column - patch.first_column;
    if (in_patch < 0 || in_patch > patch.columns - 2) continue;
    here.column = static_cast<std::size_t>(in_patch);
    here.lower = here.edge(patch.lower, here.weight);
    here.upper = here.edge(patch.upper, here.weight);
    if (log_deformation < here.lower) return none(reason);
    if (log_deformation <= here.upper) return between(patch, here, log_deformation);
    reason = patch.beyond[here.column + (share > 0.5 ? 1 : 0)];
  }
  return none(reason);
}

void StiffnessGrid::answer(std::span<const double> log_area, std::span<const double> log_deformation,
                           std::span<GridAnswer> answers) const {
  assert(log_area.size() == answers.size() && log_deformation.size() == answers.size());
  for (std::size_t i = 0; i < answers.size(); ++i) answers[i] = answer_at(log_area[i], log_deformation[i]);
}

GridAnswer StiffnessGrid::answer(double area_um2, double deformation) const {
  return answer_at(std::log(area_um2), std::log(deformation));
}

std::optional<StiffnessGrid::Range> StiffnessGrid::smooth_range(double area_um2) const {
  const double place = (std::log(area_um2) - content_.min_log_area) / content_.column_step;
  if (!(place >= 0 && place <= content_.columns - 1)) return {};
  const int column = std::min(static_cast<int>(place), content_.columns - 2);
  const Patch& bare = patches_.front();
  const Place here{static_cast<std::size_t>(column), hermite(place - column), {}, 0, 0};
  return Range{here.edge(bare.lower, here.weight), here.edge(bare.upper, here.weight)};
}

std::string grid_file_name(const std::string& identifier) { return "grid_" + identifier + ".cbor"; }

}  // namespace rheocyte

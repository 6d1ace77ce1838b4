#include "table/stiffness_grid.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "numeric/hermite.h"
#include "numeric/no_value.h"
#include "table/node_slopes.h"

namespace rheocyte {

StiffnessGrid::Patch StiffnessGrid::ready(const GridPatch& patch) {
  Patch made{patch.regularised, patch.first_column, patch.columns, patch.rows, {}, {}, {}, {}, {}};
  const auto rows = static_cast<std::size_t>(patch.rows), columns = static_cast<std::size_t>(patch.columns);
  const auto& values = patch.log_stiffness;
  assert(values.size() == rows * columns && patch.error.size() == values.size());
  const auto by_row = slopes_by_row(values, rows), by_column = slopes_by_column(values, rows),
             by_both = slopes_by_column(by_row, rows);
  for (std::size_t i = 0; i < values.size(); ++i)
    made.nodes.emplace_back(values[i], by_column[i], by_row[i], by_both[i]);
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

namespace {

/// Weights of a node's value and slopes by its place among the columns and among the rows.
Packet among_columns(double value, double slope) { return {value, slope, value, slope}; }
Packet among_rows(double value, double slope) { return {value, value, slope, slope}; }

}  // namespace

void StiffnessGrid::between(const Patch& patch, const Place& place, double log_deformation, GridAnswer& answer) const {
  const double rows_per_height = (patch.rows - 1) / (place.upper - place.lower);
  const double height = (log_deformation - place.lower) * rows_per_height;
  const int row = std::min(static_cast<int>(height), patch.rows - 2);
  const std::size_t first = place.column * static_cast<std::size_t>(patch.rows) + static_cast<std::size_t>(row);
  const Node *const a = &patch.nodes[first], *const b = a + patch.rows;
  const auto along = [](const HermiteWeights& up, const Node* node) -> Packet {
    return among_rows(up.first, up.first_slope) * node[0] + among_rows(up.last, up.last_slope) * node[1];
  };
  const auto across = [](const HermiteWeights& weight, const Packet& in_a, const Packet& in_b) {
    return (among_columns(weight.first, weight.first_slope) * in_a +
            among_columns(weight.last, weight.last_slope) * in_b)
        .sum();
  };
  const HermiteWeights up = hermite(height - row), up_change = hermite_slope(height - row);
  const Packet in_a = along(up, a), in_b = along(up, b);
  const double by_row = across(place.weight, along(up_change, a), along(up_change, b));
  // At constant deformation the height in rows changes with the borders.
  const double lower_change = place.edge(patch.lower, place.change),
               upper_change = place.edge(patch.upper, place.change);
  const double height_change =
      -rows_per_height * (lower_change + height / (patch.rows - 1) * (upper_change - lower_change));
  answer.log_stiffness = across(place.weight, in_a, in_b);
  answer.by_log_area = (across(place.change, in_a, in_b) + by_row * height_change) / content_.column_step;
  answer.by_log_deformation = by_row * rows_per_height;
  answer.error = patch.cell_error[first];
  answer.reason = NoAnswer::none;
  answer.regularised = patch.regularised;
}

// The answer is written where it stays: copies of it take longer than what is in it.
void StiffnessGrid::answer_at(double log_area, double log_deformation, GridAnswer& answer) const {
  const auto none = [&](NoAnswer reason) { answer = {no_value, no_value, no_value, no_value, reason, false}; };
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
    if (log_deformation <= here.upper) return between(patch, here, log_deformation, answer);
    reason = patch.beyond[here.column + (share > 0.5 ? 1 : 0)];
  }
  return none(reason);
}

void StiffnessGrid::answer(std::span<const double> log_area, std::span<const double> log_deformation,
                           std::span<GridAnswer> answers) const {
  assert(log_area.size() == answers.size() && log_deformation.size() == answers.size());
  for (std::size_t i = 0; i < answers.size(); ++i) answer_at(log_area[i], log_deformation[i], answers[i]);
}

GridAnswer StiffnessGrid::answer(double area_um2, double deformation) const {
  GridAnswer answer;
  answer_at(std::log(area_um2), std::log(deformation), answer);
  return answer;
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

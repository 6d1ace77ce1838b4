#include "table/stiffness_grid.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include "numeric/hermite.h"
#include "numeric/no_value.h"
#include "numeric/whole_packets.h"
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
    made.nodes.push_back({{values[i], by_column[i], by_row[i], by_both[i]}});
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

/// A place between two columns and two rows of a patch.
struct StiffnessGrid::Place {
  const Patch* patch = nullptr;  ///< null: there is none
  NoAnswer reason = NoAnswer::none;
  int column = 0;         ///< of the patch
  double share = 0;       ///< of the way to the next column
  double lower, upper;    ///< ends of the rows there
  double height;          ///< in rows
  std::size_t first = 0;  ///< the node below it

  const Node* nodes() const { return patch->nodes.data() + first; }
  int row() const { return static_cast<int>(first) - column * patch->rows; }
  double rows_per_height() const { return (patch->rows - 1) / (upper - lower); }
  double edge(const std::vector<Edge>& e, const HermiteWeights& w) const {
    const auto c = static_cast<std::size_t>(column);
    return w(e[c].value, e[c + 1].value, e[c].by_column, e[c + 1].by_column);
  }
};

namespace {

/// Weights of a node's value and slopes by its place among the columns and among the rows.
Packet among_columns(double value, double slope) { return {value, slope, value, slope}; }
Packet among_rows(double value, double slope) { return {value, value, slope, slope}; }

Packet along(const HermiteWeights& up, const auto* node) {
  using Values = Eigen::Map<const Packet, Eigen::Aligned32>;
  return among_rows(up.first, up.first_slope) * Values(node[0].values.data()) +
         among_rows(up.last, up.last_slope) * Values(node[1].values.data());
}

double across(const HermiteWeights& weight, const Packet& in_a, const Packet& in_b) {
  return (among_columns(weight.first, weight.first_slope) * in_a + among_columns(weight.last, weight.last_slope) * in_b)
      .sum();
}

}  // namespace

StiffnessGrid::Place StiffnessGrid::place_of(double log_area, double log_deformation) const {
  Place here;
  const auto none = [&](NoAnswer reason) {
    here.patch = nullptr;
    here.reason = reason;
    return here;
  };
  const double place = (log_area - content_.min_log_area) / content_.column_step;
  if (std::isnan(place) || std::isnan(log_deformation)) return none(NoAnswer::invalid);
  if (place < 0) return none(NoAnswer::too_small);
  if (place > content_.columns - 1) return none(NoAnswer::too_large);
  const int column = std::min(static_cast<int>(place), content_.columns - 2);
  here.share = place - column;
  const HermiteWeights weight = hermite(here.share);
  NoAnswer reason = NoAnswer::too_stiff;
  for (const Patch& patch : patches_) {
    here.column = column - patch.first_column;
    if (here.column < 0 || here.column > patch.columns - 2) continue;
    here.lower = here.edge(patch.lower, weight);
    here.upper = here.edge(patch.upper, weight);
    if (log_deformation < here.lower) return none(reason);
    if (log_deformation <= here.upper) {
      here.patch = &patch;
      here.height = (log_deformation - here.lower) * here.rows_per_height();
      here.first =
          static_cast<std::size_t>(here.column * patch.rows + std::min(static_cast<int>(here.height), patch.rows - 2));
      return here;
    }
    reason = patch.beyond[static_cast<std::size_t>(here.column + (here.share > 0.5 ? 1 : 0))];
  }
  return none(reason);
}

double StiffnessGrid::value_at(const Place& place) const {
  if (!place.patch) return no_value;
  const Node *const a = place.nodes(), *const b = a + place.patch->rows;
  const HermiteWeights up = hermite(place.height - place.row());
  return across(hermite(place.share), along(up, a), along(up, b));
}

// The answer is written where it stays: copies of it take longer than what is in it.
void StiffnessGrid::answer_at(const Place& place, GridAnswer& answer) const {
  if (!place.patch) {
    answer = {no_value, no_value, no_value, no_value, place.reason, false};
    return;
  }
  const Patch& patch = *place.patch;
  const Node *const a = place.nodes(), *const b = a + patch.rows;
  const double in_row = place.height - place.row(), rows_per_height = place.rows_per_height();
  const HermiteWeights up = hermite(in_row), up_change = hermite_slope(in_row), weight = hermite(place.share),
                       change = hermite_slope(place.share);
  const Packet in_a = along(up, a), in_b = along(up, b);
  const double by_row = across(weight, along(up_change, a), along(up_change, b));
  // At constant deformation the height in rows changes with the borders.
  const double lower_change = place.edge(patch.lower, change), upper_change = place.edge(patch.upper, change);
  const double height_change =
      -rows_per_height * (lower_change + place.height / (patch.rows - 1) * (upper_change - lower_change));
  answer.log_stiffness = across(weight, in_a, in_b);
  answer.by_log_area = (across(change, in_a, in_b) + by_row * height_change) / content_.column_step;
  answer.by_log_deformation = by_row * rows_per_height;
  answer.error = patch.cell_error[place.first];
  answer.reason = NoAnswer::none;
  answer.regularised = patch.regularised;
}

// The nodes of a batch are on their way from memory while those before them are worked on.
template <class Take>
void StiffnessGrid::at_places(std::span<const double> log_area, std::span<const double> log_deformation,
                              const Take& take) const {
  assert(log_area.size() == log_deformation.size());
  constexpr std::size_t batch = 16;
  std::array<Place, batch> places;
  for (std::size_t first = 0; first < log_area.size(); first += batch) {
    const std::size_t count = std::min(batch, log_area.size() - first);
    for (std::size_t i = 0; i < count; ++i) {
      const Place& place = places[i] = place_of(log_area[first + i], log_deformation[first + i]);
      if (!place.patch) continue;
      for (const Node* node : {place.nodes(), place.nodes() + place.patch->rows}) {
        __builtin_prefetch(node);
        __builtin_prefetch(node + 1);
      }
    }
    for (std::size_t i = 0; i < count; ++i) take(first + i, places[i]);
  }
}

void StiffnessGrid::answer(std::span<const double> log_area, std::span<const double> log_deformation,
                           std::span<GridAnswer> answers) const {
  assert(log_area.size() == answers.size());
  at_places(log_area, log_deformation, [&](std::size_t i, const Place& place) { answer_at(place, answers[i]); });
}

void StiffnessGrid::values(std::span<const double> log_area, std::span<const double> log_deformation,
                           std::span<double> log_stiffness) const {
  assert(log_area.size() == log_stiffness.size());
  at_places(log_area, log_deformation, [&](std::size_t i, const Place& place) { log_stiffness[i] = value_at(place); });
}

GridAnswer StiffnessGrid::answer(double area_um2, double deformation) const {
  GridAnswer answer;
  answer_at(place_of(std::log(area_um2), std::log(deformation)), answer);
  return answer;
}

std::optional<StiffnessGrid::Range> StiffnessGrid::smooth_range(double area_um2) const {
  const double place = (std::log(area_um2) - content_.min_log_area) / content_.column_step;
  if (!(place >= 0 && place <= content_.columns - 1)) return {};
  const Patch& bare = patches_.front();
  Place here;
  here.column = std::min(static_cast<int>(place), content_.columns - 2);
  const HermiteWeights weight = hermite(place - here.column);
  return Range{here.edge(bare.lower, weight), here.edge(bare.upper, weight)};
}

std::string grid_file_name(const std::string& identifier) { return "grid_" + identifier + ".cbor"; }

}  // namespace rheocyte

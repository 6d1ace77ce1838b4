#include "table/stiffness_grid.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "numeric/no_value.h"

namespace rheocyte {

StiffnessGrid::Patch::Patch(const GridPatch& patch)
    : regularised(patch.regularised),
      first_column(patch.first_column),
      grid(patch.lower, patch.upper, patch.rows),
      log_stiffness(grid.field(patch.log_stiffness)),
      cell_error(patch.error.size(), 0) {
  assert(grid.columns() == patch.columns && patch.error.size() == log_stiffness.size());
  for (const double reason : patch.beyond) beyond.push_back(static_cast<OutOfTable>(static_cast<int>(reason)));
  const auto rows = static_cast<std::size_t>(patch.rows), columns = static_cast<std::size_t>(patch.columns);
  for (std::size_t c = 0; c + 1 < columns; ++c)
    for (std::size_t row = 0; row + 1 < rows; ++row) {
      const std::size_t i = c * rows + row;
      cell_error[i] = std::max({patch.error[i], patch.error[i + 1], patch.error[i + rows], patch.error[i + rows + 1]});
    }
}

StiffnessGrid::StiffnessGrid(GridContent content) : content_(std::move(content)) {
  for (const auto& patch : content_.patches) patches_.emplace_back(patch);
}

/// In one of the patches.
struct StiffnessGrid::Place {
  const Patch* patch = nullptr;  ///< null: in none
  OutOfTable reason = OutOfTable::none;
  CurvedGrid::Place in_patch = {};

  const CurvedGrid::Node* nodes() const { return &patch->log_stiffness[patch->grid.node(in_patch)]; }
};

StiffnessGrid::Place StiffnessGrid::place_of(double log_area, double log_deformation) const {
  Place here;
  const auto none = [&](OutOfTable reason) {
    here.patch = nullptr;
    here.reason = reason;
    return here;
  };
  const double place = (log_area - content_.min_log_area) / content_.column_step;
  if (std::isnan(place) || std::isnan(log_deformation)) return none(OutOfTable::invalid);
  if (place < 0) return none(OutOfTable::too_small);
  if (place > content_.columns - 1) return none(OutOfTable::too_large);
  const int column = std::min(static_cast<int>(place), content_.columns - 2);
  const double fraction = place - column;
  OutOfTable reason = OutOfTable::too_stiff;
  for (const Patch& patch : patches_) {
    const int in_patch = column - patch.first_column;
    if (in_patch < 0 || in_patch > patch.grid.columns() - 2) continue;
    here.in_patch = patch.grid.between_columns(in_patch, fraction);
    if (log_deformation < here.in_patch.lower) return none(reason);
    if (log_deformation <= here.in_patch.upper) {
      here.patch = &patch;
      patch.grid.set_height(here.in_patch, log_deformation);
      return here;
    }
    reason = patch.beyond[static_cast<std::size_t>(in_patch + (fraction > 0.5 ? 1 : 0))];
  }
  return none(reason);
}

double StiffnessGrid::value_at(const Place& place) const {
  return place.patch ? place.patch->grid.value(place.patch->log_stiffness, place.in_patch) : no_value;
}

// The answer is written where it stays: copies of it take longer than what is in it.
void StiffnessGrid::answer_at(const Place& place, GridAnswer& answer) const {
  if (!place.patch) {
    answer = {no_value, no_value, no_value, no_value, place.reason, false};
    return;
  }
  const Patch& patch = *place.patch;
  const auto [value, by_column, by_height] = patch.grid.answer(patch.log_stiffness, place.in_patch);
  answer.log_stiffness = value;
  answer.by_log_area = by_column / content_.column_step;
  answer.by_log_deformation = by_height;
  answer.error = patch.cell_error[patch.grid.node(place.in_patch)];
  answer.reason = OutOfTable::none;
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
      for (const CurvedGrid::Node* node : {place.nodes(), place.nodes() + place.patch->grid.rows()}) {
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
  const int column = std::min(static_cast<int>(place), content_.columns - 2);
  const CurvedGrid::Place here = patches_.front().grid.between_columns(column, place - column);
  return Range{here.lower, here.upper};
}

std::string grid_file_name(const std::string& identifier) { return "grid_" + identifier + ".cbor"; }

}  // namespace rheocyte

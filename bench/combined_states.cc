// What a combined table says of cells: combined_states TABLE < CELLS
//
// A line of CELLS is r0 (um), E (kPa), E2D (mN/m), the tension of the cortex over E2D, and that of the liquid (Pa), in
// the table's own channel and flow. Prints ln(area / um2), deformation, Lambda1 / Lambda2, c2 .. c7, or "none" outside
// the table.
#include <fmt/format.h>

#include <cmath>
#include <iostream>
#include <optional>
#include <string>

#include "program.h"
#include "table/combined_interpolation.h"

namespace {

using namespace rheocyte;

constexpr int last_mode = 7;

/// The first state with this stiffness, which falls with the progress along a branch; nothing outside the table.
std::optional<CombinedState> with_stiffness(const CombinedInterpolation& table, CellCoordinates cell,
                                            double log_stiffness) {
  constexpr int steps = 400, halvings = 40;
  const double first = table.box().least(x_progress), step = (table.box().greatest(x_progress) - first) / steps;
  const auto at = [&](double place) {
    cell(x_progress) = place;
    return table.at(cell);
  };
  const auto is_above = [&](double place) { return at(place).value(log_stiffness_row) > log_stiffness; };
  for (int k = 0; k < steps; ++k) {
    double least = first + k * step, greatest = least + step;
    if (!at(least).inside || !at(greatest).inside || !is_above(least) || is_above(greatest)) continue;
    for (int h = 0; h < halvings; ++h) (is_above((least + greatest) / 2) ? least : greatest) = (least + greatest) / 2;
    return at(least);
  }
  return {};
}

std::string told(const CombinedState& state) {
  std::string line = fmt::format("{:.6f} {:.6f} {:.6f}", state.value(log_area_row), state.value(deformation_row),
                                 state.value(moment_ratio_row));
  for (int k = min_mode; k <= last_mode; ++k)
    line += fmt::format(" {:.6f}", state.value(first_mode_row + k - min_mode));
  return line;
}

}  // namespace

int rheocyte::measure(int argc, char** argv) {
  if (argc != 2) return fmt::print("combined_states TABLE < CELLS\n"), 2;
  const CombinedInterpolation table(read_combined_table(argv[1]));
  double radius = 0, young = 0, cortex = 0, ratio = 0, axial_Pa = 0;
  while (std::cin >> radius >> young >> cortex >> ratio >> axial_Pa) {
    const double stiffness = young + cortex / radius;
    const CellCoordinates cell{std::log(radius), cortex / radius / stiffness, 0, ratio, 1e-3 * axial_Pa / stiffness};
    const auto state = with_stiffness(table, cell, std::log(stiffness));
    fmt::print("{}\n", state ? told(*state) : "none");
  }
  return 0;
}

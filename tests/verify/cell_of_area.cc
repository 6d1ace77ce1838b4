#include "cell_of_area.h"

#include <cmath>
#include <numbers>

#include "case/problem.h"
#include "laboratory.h"

namespace rheocyte::test {

CellOfArea cell_of_area(Problem like, double area_um2) {
  constexpr int max_steps = 8;
  constexpr double tolerance = 1e-5;
  const double unit_area = tube_radius_um * tube_radius_um;
  CellOfArea cell;
  cell.radius_um = 0.99 * std::sqrt(area_um2 / std::numbers::pi);
  double slope = 2 / cell.radius_um;  // d(relative area)/d(radius) of a cell that stays a sphere
  double last_radius = 0, last_error = 0;
  for (int step = 0; step < max_steps; ++step) {
    like.radius_ratio = cell.radius_um / tube_radius_um;
    cell.state = solve_stationary(like);
    cell.area_error = cell.state.shape.area * unit_area / area_um2 - 1;
    if (cell.state.outcome.status != Status::converged || std::abs(cell.area_error) < tolerance) break;
    if (step > 0) slope = (cell.area_error - last_error) / (cell.radius_um - last_radius);
    last_radius = cell.radius_um;
    last_error = cell.area_error;
    cell.radius_um -= cell.area_error / slope;
  }
  return cell;
}

}  // namespace rheocyte::test

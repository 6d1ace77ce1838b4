// How BulkCortexFit gets to the cell that fits best.
#include <algorithm>
#include <cmath>

#include "infer/bulk_cortex_fit.h"
#include "infer/moduli_misfit.h"
#include "numeric/minimise_squares.h"

namespace rheocyte {

// All coordinates free, then that of fraction and tension which left the table farthest held at its border, until none
// is. One that is held where the features would be nearer inside is free once more: the way there led along the border.
BulkCortexFit::Candidate BulkCortexFit::minimum_from(ModuliMisfit& misfit, const CellCoordinates& start,
                                                     Fraction fraction) const {
  std::vector<int> free{x_radius, x_progress}, held;
  if (fraction == Fraction::fitted && has_free_fraction()) free.push_back(x_fraction);
  if (options_.free_tension) free.push_back(x_ratio);
  if (table_.is_elongated()) free.push_back(x_axial);
  CellCoordinates cell = start;
  const CellBox& box = table_.box();
  const CellCoordinates width = widths(box);
  const auto residuals = [&](const Eigen::VectorXd& x, Eigen::MatrixXd* slopes) { return misfit.residuals(x, slopes); };
  int releases = int(free.size());
  const auto leads_inside = [&](int coordinate) {
    misfit.set_free({x_progress, coordinate}, cell);
    Eigen::MatrixXd slopes;
    const Eigen::VectorXd off = misfit.residuals(misfit.parameters(), &slopes);
    const double rise = slopes.col(1).dot(off);
    return cell(coordinate) <= box.least(coordinate) ? rise < 0 : rise > 0;
  };
  while (true) {
    misfit.set_free(free, cell);
    Eigen::VectorXd x = misfit.parameters();
    const double chi_squared = minimise_squares(residuals, x);
    cell = misfit.cell_at(x);
    if (!cell.allFinite() || !std::isfinite(chi_squared)) return {start, HUGE_VAL};
    const CellCoordinates inside = cell.cwiseMax(box.least).cwiseMin(box.greatest),
                          beyond = (cell - inside).cwiseAbs().cwiseQuotient(width);
    const auto outside = [&](int coordinate) {
      return coordinate == x_fraction || coordinate == x_ratio ? beyond(coordinate) : 0;
    };
    const auto farthest = std::ranges::max_element(free, {}, outside);
    if (outside(*farthest) > 0) {
      cell(*farthest) = inside(*farthest);
      held.push_back(*farthest);
      free.erase(farthest);
      continue;
    }
    const auto released = std::ranges::find_if(held, leads_inside);
    if (released != held.end() && releases-- > 0) {
      free.push_back(*released);
      held.clear();
      continue;
    }
    // Without a cortex no ratio is better than another, and errors depend on it.
    if (options_.free_tension && cell(x_fraction) == 0) cell(x_ratio) = middle_ratio();
    return {cell, chi_squared};
  }
}

// Where the tension is about as great as the stiffness the features say little of it by themselves, and the way down
// from a start that is far off ends in another valley.
CellCoordinates BulkCortexFit::with_best_stiffness(ModuliMisfit& misfit, const CellCoordinates& start) {
  CellCoordinates best = start;
  double least = HUGE_VAL;
  misfit.set_free({x_progress}, start);
  const Eigen::VectorXd at_start = misfit.parameters();
  for (const double change_of_logarithm : {0.0, -0.8, -0.4, 0.4, 0.8}) {
    misfit.set_free({x_progress}, start);  // each search for a progress begins there
    const Eigen::VectorXd x = at_start.array() + change_of_logarithm;
    const double chi_squared = misfit.residuals(x).squaredNorm();
    if (chi_squared >= least) continue;
    least = chi_squared;
    best = misfit.cell_at(x);
  }
  return best;
}

BulkCortexFit::Candidate BulkCortexFit::nearest(ModuliMisfit& misfit, const CellCoordinates* way_begins) const {
  if (way_begins) return minimum_from(misfit, *way_begins, Fraction::fitted);
  const CellBox& box = table_.box();
  CellCoordinates start = start_for(misfit.shape());
  std::vector<Candidate> minima;
  const auto places = has_free_fraction() ? std::vector{0.1, 0.5, 0.9} : std::vector{0.5};
  for (const double place : places) {
    start(x_fraction) = box.least(x_fraction) + place * (box.greatest(x_fraction) - box.least(x_fraction));
    minima.push_back(minimum_from(misfit, with_best_stiffness(misfit, start), Fraction::fitted));
  }
  return *std::ranges::min_element(minima, {}, &Candidate::chi_squared);
}

}  // namespace rheocyte

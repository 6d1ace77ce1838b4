// Lines of equal Young's modulus and the region of support of a grid (docs/plot-and-synth.md, sec. "lines").
#pragma once
#include <span>
#include <vector>

#include "infer/level_lines.h"
#include "table/stiffness_grid.h"

namespace rheocyte {

/// As LineFinder, for a grid of rheocyte's own tables: where the bare surface is smooth.
class GridLineFinder {
 public:
  /// UserError if the grid's stiffness is not Young's modulus.
  explicit GridLineFinder(GridContent grid);

  std::vector<double> even_levels(int count) const;
  LevelLines lines(std::span<const double> levels_kPa) const;
  std::vector<PlanePoint> support() const;

 private:
  double area_at(int column) const;
  LevelLine line(double modulus_kPa) const;

  StiffnessGrid grid_;
};

}  // namespace rheocyte

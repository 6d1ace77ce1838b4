// Errors of pixels for all cells of a combined table.
#pragma once
#include <array>
#include <vector>

#include "infer/several_moduli.h"
#include "table/combined_interpolation.h"

namespace rheocyte {

/// Bias and covariance of the features of a shape at a few radii, shares and deformations of a table, by rendering at
/// random positions; linear in ln r0, share and ln d between them. Repeatable.
class PixelLaw {
 public:
  /// The pixel as wide as in the table's channel: pixel size x table's width / recording's width.
  PixelLaw(const CombinedInterpolation& table, double pixel_size_um, int draws = 200);

  ShapeErrors at(const CellCoordinates& cell) const;
  CellCoordinates middle() const { return (box_.least + box_.greatest) / 2; }

 private:
  static constexpr int axes = 3;
  static constexpr std::array<int, axes> nodes{6, 3, 6};

  CellBox box_;
  std::vector<ShapeErrors> errors_;
};

/// The moduli of a cell in pixels: the errors are those of the law at the cell that is found.
ModuliEstimate fit_pixels(const SeveralModuli& moduli, const PixelLaw& law, const ShapeVector& measured,
                          const FlowConditions& conditions);

}  // namespace rheocyte

// What a table's cells look like, and what that says about measured ones: whether they have such shapes, and their
// Young's modulus from the asymmetry of the outline (docs/theory-extract.md, sec. "Shapes").
#pragma once
#include <optional>

#include "infer/modulus_map.h"
#include "infer/shape_excess.h"
#include "table/shape_grid.h"
#include "table/stiffness_grid.h"

namespace rheocyte {

/// Cosine modes of the outline's radius, c_2 and c_3, one value per event; those of a cell that moves towards +x.
struct MeasuredModes {
  std::span<const double> mode_2, mode_3;
};

struct SmoothEvents;

class ShapeMap {
 public:
  /// The grid must hold shapes (asserted), and its stiffness must be Young's modulus.
  explicit ShapeMap(const StiffnessGrid& grid);

  const TableOrigin& origin() const { return origin_; }
  /// Whether the asymmetry tells the modulus.
  bool has_asymmetry() const { return by_asymmetry_.has_value(); }
  /// Sign of c_3 of a cell that moves towards +x.
  double sign_of_asymmetry() const { return sign_; }

  /// Spans of one length; the excess is NaN where a number is missing, and outside the areas of the table. Cells that
  /// are deformed more than the table's softest count as these.
  void compare(const MeasuringConditions& conditions, const MeasuredEvents& events,
               std::span<const double> inertia_ratios, std::span<ShapeExcess> excesses) const;

  /// Young's modulus by area and c_3, without what the pixels do to both, and an ellipse that the table's cells do not
  /// have: c_2 beyond that of the table's cell with this c_3 counts as added to the outline (added_ellipse.h). Cells
  /// that are asymmetric the other way round count as too stiff. Only where has_asymmetry() (asserted). The
  /// deformations of the events serve to know the pixels' part of the area.
  void estimate(const MeasuringConditions& conditions, const MeasuredEvents& events, const MeasuredModes& modes,
                const EstimatedModuli& moduli) const;

  /// Inertia ratio of the table's cell, in the channel of the table.
  double inertia_ratio(double area_um2, double deformation) const;
  const ShapeGrid& shapes() const { return shapes_; }

 private:
  struct SmoothAsymmetries;
  void estimate_block(const MeasuringConditions& conditions, const MeasuredEvents& block, const MeasuredModes& modes,
                      const EstimatedModuli& moduli) const;
  /// Without what the pixels do.
  void smooth_modes(double pixel_size_um, const MeasuredModes& modes, const SmoothEvents& smooth,
                    SmoothAsymmetries& asymmetry) const;
  /// Changes ln(area), in the table's channel, and the asymmetry.
  void remove_ellipses(std::span<const double> mode_2, SmoothEvents& smooth, SmoothAsymmetries& asymmetry) const;

  TableOrigin origin_;
  ShapeGrid shapes_;
  double sign_;
  /// Their rows are those of ln|c_3| in place of ln(deformation); the second one tells c_2.
  std::optional<StiffnessGrid> by_asymmetry_, mode_2_;
};

/// 1 - 2 sqrt(pi A) / P of an ellipse with this ratio of its axes.
double deformation_of_ellipse(double ratio);

/// What pixels do to the inertia ratio at random; on average they leave it alone.
double inertia_ratio_deviation(double area_um2, double pixel_size_um);

}  // namespace rheocyte

// Errors of pixels of all features of a shape, for all cells of a combined table: what the fit of several moduli needs.
//
// Young's modulus of a solid needs area and deformation only, for millions of events in a second: that is the fitted
// law of measurement/pixel_errors.h. Several moduli need the covariance of all modes, and the shape between solid and
// shell, of which area and deformation alone determine nothing. Rendering costs about a second for each recording,
// beside a fit of milliseconds for each event. For solids both agree (tests/infer/rendered_errors_test.cc).
#pragma once
#include <array>
#include <optional>
#include <vector>

#include "infer/bulk_cortex_fit.h"
#include "infer/square_law.h"
#include "measurement/outline_noise.h"
#include "numeric/cell_random.h"
#include "table/combined_interpolation.h"

namespace rheocyte {

/// Bias (measured - true) and covariance of the features of a true shape at a few radii, fractions and deformations of
/// a table, and axial ratios where it has some, by rendering at random positions; linear in the coordinates between
/// them. Repeatable.
class RenderedErrors {
 public:
  /// The table must outlive it. The pixel (um) as wide as in the table's channel: pixel size x table's width /
  /// recording's width; so the errors of the outlines.
  RenderedErrors(const CombinedInterpolation& table, double pixel_size_um, const OutlineNoise& noise_um = {},
                 int draws = 200);

  /// Between those: within a fifth of the noise of a picture.
  ShapeErrors at(const CellCoordinates& cell) const;
  /// Of this very cell, which takes some milliseconds, at places that these random numbers tell; of one outside the
  /// table as above.
  ShapeErrors of(const CellCoordinates& cell, CellRandom random) const;
  /// Of a smooth outline in the table's channel, which takes some milliseconds.
  ShapeErrors of_outline(const ShapeVector& shape, CellRandom random) const;
  CellCoordinates middle() const { return (box_.least + box_.greatest) / 2; }

 private:
  using Nodes = std::array<int, coordinate_count>;
  static std::size_t count_of(const Nodes& nodes);
  ShapeErrors rendered(const CombinedState& state, int draws, CellRandom& random) const;

  /// In which the errors are linear: pixels take a fraction of the third mode of elongated cells, not of its logarithm.
  double scale(int axis, double coordinate) const;
  double node_place(int axis, double fraction) const;

  const CombinedInterpolation& table_;
  double pixel_size_um_;
  OutlineNoise noise_um_;
  CellBox box_;
  bool is_over_mode_3_ = false;
  Nodes nodes_{6, 3, 6, 1, 1};  ///< along each coordinate
  std::vector<ShapeErrors> errors_;
};

/// Of the area and the modes of a shape without pixels.
Eigen::MatrixX2d outline_of(const ShapeVector& smooth);

/// A shape with what pixels and the square channel add to it.
struct SeenShape {
  MeasuredShape shape;
  double section_factor = 1;  ///< see ModuliEstimate
};
/// How a cell is seen: in which channel, of which section.
struct Sight {
  ChannelFlow flow;
  Section section = Section::tube;
  double error_factor = 1;  ///< by how much more the law of the square channel leaves of cells of these laws
};
/// What is added is that at the nearest cell of the table, the axial tension being known so well; the noise of pixels
/// is that of the mean of so many pictures, and of several their errors are those of their own outline. Nothing where a
/// feature is not a number.
std::optional<SeenShape> seen_shape(const BulkCortexFit& moduli, const RenderedErrors& errors,
                                    const ShapeVector& measured, const Sight& sight, const AxialTension& tension,
                                    double pictures = 1);

/// The moduli of a cell in pixels.
ModuliEstimate fit_pixels(const BulkCortexFit& moduli, const RenderedErrors& errors, const ShapeVector& measured,
                          const Sight& sight, const AxialTension& tension = {});

}  // namespace rheocyte

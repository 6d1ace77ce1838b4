// Shapes of cells in a square channel against those in the tube for which a combined table was computed
// (docs/theory-extract.md, sec. "The square channel").
#pragma once
#include "infer/square_solids.h"
#include "table/combined_interpolation.h"

namespace rheocyte {

class SquareShapes {
 public:
  /// Both tables must outlive it; that of the tube has the solids of the other one as its share 0 (asserted), and was
  /// computed in the given channel and flow.
  SquareShapes(const CombinedInterpolation& tube, const ChannelFlow& simulated, const ModulusMap& square);

  /// What is added to the features of a cell of the tube's table that is seen in the square channel, as a stationary
  /// solid with this area and deformation tells, or third mode where the table is one of elongated cells, less what it
  /// is less with such a share of the cortex, and how well that is known. The shape is one without pixels, as seen in a
  /// channel with this flow.
  struct Change {
    ShapeErrors errors;
    double factor_of_mode_3 = 1;
  };
  Change change(const ShapeVector& smooth, const ChannelFlow& flow, double cortex_share) const;

 private:
  /// The solid of the tube with this area, and a modulus that the table has.
  struct Solid {
    double modulus_kPa;
    ShapeVector shape;
  };
  Solid solid_of(double area_um2, double modulus_kPa) const;

  const CombinedInterpolation& tube_;
  ChannelFlow simulated_;
  SquareSolids square_;
};

}  // namespace rheocyte

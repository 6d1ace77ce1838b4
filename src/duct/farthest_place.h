// Where a cell's surface reaches farthest in a direction: the outline of a cell off the axis is no line of the mesh,
// but made of such places (docs/theory-square.md, sec. "Cells off the axis").
#pragma once
#include "duct/duct_surface.h"

namespace rheocyte {

/// Of the half of a cell that is computed.
class FarthestPlace {
 public:
  /// The surface must outlive this object.
  explicit FarthestPlace(const DuctSurfaceMap&);

  SurfacePlace operator()(const DuctPoint& direction) const;

 private:
  SurfacePlace climb(SurfacePlace, const DuctPoint& direction) const;

  const DuctSurfaceMap& surface_;
  std::vector<SurfacePlace> samples_;
  Eigen::MatrixX3d sampled_;
};

}  // namespace rheocyte

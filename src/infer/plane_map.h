// A forward map by its values on a grid.
#pragma once
#include <memory>
#include <vector>

#include "population/forward_map.h"

namespace rheocyte {

struct PlaneNode {
  double log_area;  ///< less 2 u
  double measure;
  double area_variance, covariance, measure_variance;
};

/// Nodes of equal distance in u and in exp(-x), which goes from 1 to 0: of such cells all numbers are smooth functions.
struct PlaneGrid {
  ForwardMap::Interval log_radii;
  double stiffest;  ///< greatest x of the map
  int radii, heights;
  std::vector<double> soft_end;  ///< by radius
  std::vector<PlaneNode> nodes;  ///< by radius, within it from soft to stiff
};

/// Cubics between the nodes, of which there are at least four each (asserted).
std::shared_ptr<const ForwardMap> make_plane_map(PlaneGrid grid);

}  // namespace rheocyte

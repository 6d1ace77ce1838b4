// The mesh of cell and channel: quadrilaterals that subdivide the blocks of the geometry.
#pragma once
#include <array>
#include <vector>

#include "fem/channel_geometry.h"
#include "fem/node_numbers.h"

namespace rheocyte {

/// How finely the blocks are divided.
struct Subdivision {
  int front = 2;   ///< elements along the front's surface, the same at the rear
  int top = 4;     ///< elements along the top's surface
  int ring = 1;    ///< layers of the cell round its core
  int axial = 2;   ///< elements from the box to each end of the shortest channel
  int layers = 0;  ///< of liquid from the surface to the box, each twice as high as the one below; 0: layers_for()
  bool operator==(const Subdivision&) const = default;
};

/// As many layers of liquid as make the first one half as high as the surface's elements are wide: taller elements
/// resolve the liquid's answer to short waves of the surface along it but not across it, and the surface then loses
/// stability numerically, long before the solid does.
int layers_for(const ChannelGeometry&, const Subdivision&);

/// One quadrilateral: a rectangle [outward] x [along] of a block's parameters.
struct MeshElement {
  Block block;
  bool outward_first;  ///< whether the element's first coordinate runs outward (kept right-handed)
  std::array<double, 2> outward, along;

  /// Point of the undeformed mesh for element coordinates in [0,1]^2.
  Point map(const ChannelGeometry&, double xi1, double xi2) const;
  /// The same point in the block's parameters (outward, along).
  std::array<double, 2> parameters(double xi1, double xi2) const;
};

class ChannelMesh {
 public:
  ChannelMesh(const ChannelGeometry&, const Subdivision&);

  const ChannelGeometry& geometry() const { return geometry_; }
  const std::vector<MeshElement>& elements() const { return elements_; }
  /// Of the Gauss-Lobatto nodes of continuous elements of one degree.
  NodeNumbers number_nodes(int degree) const;

 private:
  void add_block(Block, const std::vector<double>& outward, const std::vector<double>& along);

  ChannelGeometry geometry_;
  std::vector<MeshElement> elements_;
};

}  // namespace rheocyte

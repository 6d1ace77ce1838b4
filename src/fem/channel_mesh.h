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

/// Where the elements along the surface are shorter.
enum class Spacing {
  even,      ///< nowhere
  by_shear,  ///< near the poles, and where the shear rate on the surface vanishes in a ring before the rear: there the
             ///< shear stress of a shear-thinning liquid has an infinite slope. Twice as many elements on top
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
  std::array<double, 2> along_axis;  ///< in the core, `along` where it meets the axis

  /// Point of the undeformed mesh for element coordinates in [0,1]^2.
  Point map(const ChannelGeometry&, double xi1, double xi2) const;
  /// The same point in the block's parameters (outward, along).
  std::array<double, 2> parameters(double xi1, double xi2) const;
  /// Its coordinates at these parameters.
  std::array<double, 2> coordinates(double outward, double along) const;
  bool is_skewed() const { return along_axis != along; }
};

/// Between the elements along the surface of front and top, as parts of their angles, 0 and 1 included; those of the
/// rear are the front's.
struct SurfaceBreaks {
  std::vector<double> front, top;
  /// Where the lines of the core that go on to those of the top meet the axis, if not at the same parts: elements that
  /// are short at the surface need not be so in the middle of the cell.
  std::vector<double> axis = {};
};
/// The breaks of a few intervals, or such as lie between them for another number of intervals.
std::vector<double> like(const std::vector<double>& breaks, int intervals);
SurfaceBreaks surface_breaks(const Subdivision&, Spacing);
/// Those of another mesh, or such as lie between them, as many as given.
SurfaceBreaks like(const SurfaceBreaks&, const SurfaceBreaks& numbers);

class ChannelMesh {
 public:
  ChannelMesh(const ChannelGeometry& geometry, const Subdivision& subdivision, Spacing spacing = Spacing::even)
      : ChannelMesh(geometry, subdivision, surface_breaks(subdivision, spacing)) {}
  ChannelMesh(const ChannelGeometry&, const Subdivision&, SurfaceBreaks);

  const ChannelGeometry& geometry() const { return geometry_; }
  const std::vector<MeshElement>& elements() const { return elements_; }
  const SurfaceBreaks& breaks() const { return breaks_; }
  /// Between the edges on the surface, both poles included: the front from 0 to 1, the top to 3, the rear to 4, in
  /// proportion to the angles of the undeformed cell.
  std::vector<double> surface_places() const;
  /// Of the Gauss-Lobatto nodes of continuous elements of one degree.
  NodeNumbers number_nodes(int degree) const;

 private:
  void add_block(Block, const std::vector<double>& outward, const std::vector<double>& along,
                 const std::vector<double>& along_axis);

  ChannelGeometry geometry_;
  SurfaceBreaks breaks_;
  std::vector<MeshElement> elements_;
};

}  // namespace rheocyte

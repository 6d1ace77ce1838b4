// A straight duct with a cell, as a few smooth blocks (docs/theory-square.md, sec. mesh). The cell is a ball; its
// surface is the surface of the cube [-1, 1]^3 under a map that is smooth in each wedge, and the cube's faces X = 1,
// X = -1 look along the flow.
//
// Lengths in the duct's half width h (in a rectangle half the lesser of width and height, in a tube the radius); x
// along the flow, y along the width, z along the height.
#pragma once
#include <Eigen/Core>

#include "case/problem.h"
#include "duct/duct_symmetry.h"

namespace rheocyte {

/// The cell's core, the ring round it, the liquid that follows its surface, and the liquid beyond.
enum class Part { core, ring, layers, end };

/// A duct and the cell in it.
struct DuctShape {
  Section section = Section::square;
  double radius = 0.5;  ///< of the cell
  Extent extent = {};   ///< of a rectangle
  double length = 0;    ///< of the reported duct; 0: the shortest
  double run_out = 0;   ///< by which the mesh goes on beyond it at both ends
  double offset = 0;    ///< of the cell's centre in y
  /// Half-length of the box round the cell, and of its front edge at the wall that is nearer to a cell off the axis of
  /// a funnel; 0: as far as the cell disturbs the flow, and the channel is straight along y.
  double box = 0, edge = 0;
  bool narrows_in_height = false;  ///< a wall that is not straight: along z, else along y
};

class DuctGeometry {
 public:
  explicit DuctGeometry(const DuctShape&);
  DuctGeometry(Section section, double radius_ratio) : DuctGeometry(DuctShape{section, radius_ratio}) {}
  /// The same for elements across the planes y = z and y = -z, where the map of wedges has kinks.
  DuctGeometry across_wedges() const;

  /// Where a part's point lies whose coordinate `outward` runs from 0 to 1: in the ring from the core to the surface,
  /// in the layers from there to the box or the wall, in the ends from the box to the channel's end, and on to 2 where
  /// the mesh goes on beyond it. `cube` is the point of the cube's surface that it belongs to, in the core the point in
  /// the cube.
  DuctPoint map(Part, const DuctPoint& cube, double outward) const;

  /// (y, z) of that point of the liquid, seen from the cell, in a duct that is not straight (docs/theory-time.md,
  /// eq:planar-wall): where the wall's half width is `stretch` times that of the straight one, in a tube both ways
  /// across the flow, else along the width alone; and with the cell `aside` of its place along y.
  Eigen::Vector2d across(Part, const DuctPoint& cube, double outward, double stretch, double aside) const;

  bool is_wall(const DuctPoint&) const;
  const DuctShape& shape() const { return shape_; }
  Section section() const { return shape_.section; }
  double radius() const { return shape_.radius; }
  /// Of the cross-section.
  double area() const;
  /// Half-length of the box whose faces the spokes of front and rear end at.
  double box() const { return box_; }
  /// Half-length of the shortest duct of this section, and of this one.
  double min_length() const { return min_length_; }
  double half_length() const { return half_length_; }
  /// Where the mesh ends, as x and as `outward`.
  double end() const { return half_length_ + shape_.run_out; }
  double last_outward() const { return shape_.run_out > 0 ? 2 : 1; }

 private:
  /// A point of the cube in the unit ball.
  DuctPoint ball(const DuctPoint& cube) const;
  DuctPoint surface(const DuctPoint& cube) const;
  DuctPoint core(const DuctPoint& cube) const;
  /// x of a point of the box or the wall, and its place across the duct, where the cell is at `centre` along y.
  double box_along(const DuctPoint& cube) const;
  /// x of a point beyond the box.
  double end_along(const DuctPoint& cube, double outward) const;
  Eigen::Vector2d box_across(const DuctPoint& cube, double stretch, double centre) const;

  DuctShape shape_;
  double box_, min_length_, half_length_;
  bool has_wedges_ = true;
};

/// How much of the surface's axial displacement the wall's points take over, as the mesh of the tube has it
/// (docs/theory.md, eq:spokes); 0 in front and rear.
double wall_slide(const DuctPoint& cube);

}  // namespace rheocyte

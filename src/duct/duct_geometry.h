// One eighth of a straight duct with a centred cell, 0 <= z <= y, as a few smooth blocks (docs/theory-square.md, sec.
// mesh). The cell is a ball; its surface is the surface of the cube [-1, 1]^3 under a smooth map, of which the front
// face X = 1, the rear face X = -1 and the side Y = 1 lie in this eighth.
//
// Lengths in the duct's half width h, of a tube in its radius; x along the flow.
#pragma once
#include <Eigen/Core>

#include "case/problem.h"

namespace rheocyte {

/// Face of the cube that a block's outward direction crosses.
enum class Face { front, side, rear };

/// The cell's core, the ring round it, the liquid that follows its surface, and the liquid beyond.
enum class Part { core, ring, layers, end };

/// Points of the duct, and of the faces by two coordinates in [-1, 1]: (Y, Z) in front and rear, (Z, X) on the side.
using DuctPoint = Eigen::Vector3d;
using FacePoint = Eigen::Vector2d;

class DuctGeometry {
 public:
  DuctGeometry(Section, double radius_ratio);

  /// Where a part's point lies whose coordinate `outward` runs from 0 to 1: in the ring from the core to the surface,
  /// in the layers from there to the box or the wall, in the ends from the box to the channel's end. In the core, where
  /// `face` does not matter, the coordinates are (Y, Z) and X.
  DuctPoint map(Part, Face, const FacePoint&, double outward) const;

  bool is_wall(const DuctPoint&) const;
  Section section() const { return section_; }
  double radius() const { return radius_; }
  /// Half-length of the box whose faces the spokes of front and rear end at.
  double box() const { return box_; }
  double half_length() const { return half_length_; }

 private:
  DuctPoint surface(Face, const FacePoint&) const;
  DuctPoint core(const DuctPoint& cube) const;
  DuctPoint box_side(Face, const FacePoint&) const;
  /// A point of the cross-section from coordinates 0 <= Z <= Y <= 1.
  Eigen::Vector2d across(double Y, double Z) const;

  Section section_;
  double radius_, box_, half_length_;
};

/// How much of the surface's axial displacement the wall's points take over, as the mesh of the tube has it
/// (docs/theory.md, eq:spokes).
double wall_slide(Face, const FacePoint&);

}  // namespace rheocyte

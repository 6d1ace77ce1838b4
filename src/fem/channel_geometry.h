// The undeformed half-plane of cell and channel as a few smooth blocks (docs/theory.md, sec. mesh).
//
//      wall  +--------+---------------------------+--------+
//            |        | \         top           / |        |
//  inlet     |upstream|   \  ___------___     /   |downstr.|  outlet      flow -->  x
//            |        |rear \/  cell     \  / front        |
//      axis  +--------+-----+-------------+-------+--------+
//
// Lengths in R. Angles are measured at the cell's centre from the flow direction.
#pragma once
#include <Eigen/Core>

namespace rheocyte {

enum class Sector { front, top, rear };
enum class Block { core, ring_front, ring_top, ring_rear, front, top, rear, downstream, upstream };

constexpr bool is_cell(Block block) { return block <= Block::ring_rear; }
/// Blocks of liquid that touch the cell and whose mesh follows it along spokes.
constexpr bool has_spokes(Block block) { return block >= Block::front && block <= Block::rear; }

/// Point of the meridian half-plane: (x, r).
using Point = Eigen::Vector2d;

/// Where the blocks lie. A block's map takes (outward, along) in [0,1]^2: `outward` from the centre to the channel,
/// `along` following the surface: from the axis to the corner spoke in front and rear, from front to rear on top.
/// In the core `outward` is the front's `along` (away from the axis) and `along` the top's.
class ChannelGeometry {
 public:
  /// Blocks for a cell of radius `radius_ratio` in a channel of `length` (both in R); 0: as short as it can be. The
  /// mesh goes on at both ends by `run_out`.
  explicit ChannelGeometry(double radius_ratio, double length = 0, double run_out = 0);

  Point map(Block, double outward, double along) const;

  /// Angle of the surface point `along` a sector, from the flow direction, in radians.
  double angle(Sector, double along) const;

  double radius() const { return radius_; }
  /// Of the reported channel.
  double half_length() const { return half_length_; }
  /// Where the mesh ends.
  double end() const { return half_length_ + run_out_; }
  /// Half-length of the box whose corner spokes separate front, top and rear.
  double box() const { return box_; }

 private:
  Point surface(Sector, double along) const;
  Point core_side(Sector, double along) const;
  Point core(double outward, double along) const;
  Point box_side(Sector, double along) const;

  double radius_, box_, half_length_, run_out_;
  double front_corner_, rear_corner_;  ///< angles of the corner spokes
};

}  // namespace rheocyte

// Which part of a duct is meshed. A wedge 0 <= z <= y is carried to the other seven by the symmetries of the square:
// some of its images make the part that is computed, others carry that part to the whole (docs/theory-square.md,
// sec. 3).
#pragma once
#include <Eigen/Core>
#include <vector>

#include "case/choices.h"

namespace rheocyte {

/// Points closer than this, in h, are one.
inline constexpr double same_place = 1e-10;

/// Points of the duct, x along the flow.
using DuctPoint = Eigen::Vector3d;

/// What is computed: 0 <= z <= y, where y and z may be exchanged; y, z >= 0; z >= 0.
enum class Symmetry { eighth, quarter, half };

/// Of a centred cell.
inline Symmetry symmetry_of(Section section) {
  return section == Section::rectangle ? Symmetry::quarter : Symmetry::eighth;
}

/// A symmetry of the square: y and z are exchanged, then take their signs.
struct Image {
  bool swaps = false;
  double y = 1, z = 1;

  DuctPoint operator()(const DuctPoint& x) const { return {x(0), y * x(swaps ? 2 : 1), z * x(swaps ? 1 : 2)}; }
  /// Whether right-handed becomes left-handed.
  bool mirrors() const { return swaps != (y * z < 0); }
  bool operator==(const Image&) const = default;
};

/// The wedges of the part that is computed, and the images of this part that make the duct.
std::vector<Image> wedges_of(Symmetry);
std::vector<Image> copies_of(Symmetry);

/// What the mirror planes through a point of the part do to the components y and z of a vector there.
struct Across {
  bool holds_y = false, holds_z = false;
  bool ties = false;  ///< y and z are one unknown
};
Across across_at(Symmetry, const DuctPoint&);

/// Cameras that look at right angles onto the mirror planes of the part.
std::vector<Camera> mirror_cameras(Symmetry);

/// The camera nearest to this one that looks at right angles onto a mirror plane of the part.
Camera nearest_mirror(Symmetry, Camera);

}  // namespace rheocyte

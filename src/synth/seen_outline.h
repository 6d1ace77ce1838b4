// Outlines by what is seen of them: their hulls' area, modes and deformation.
#pragma once
#include <Eigen/Core>

#include "shape/radius_modes.h"

namespace rheocyte {

/// A closed outline of outline_points points from an angle of 0 on, symmetric about the x-axis, whose hull has this
/// area, deformation, and modes c_2 .. c_7. Of the modes beyond, which tables do not hold, it has those of a hull, and
/// as much of them as makes up the deformation. Of the states of our tables the deformation is met to 2e-4 (0.4 % at
/// 0.15, where the hull bridges a deep dent), the modes to 4e-4 (there 4e-3).
Eigen::MatrixX2d outline_seen_with(const RadiusModes& modes, double deformation, double area);

}  // namespace rheocyte

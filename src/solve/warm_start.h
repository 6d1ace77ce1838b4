// Whether the state of one problem is a start for another one.
#pragma once
#include "case/problem.h"

namespace rheocyte {

/// Whether both problems differ in numbers alone.
bool has_same_laws(const Problem&, const Problem&);

/// With the same laws: whether cross-section and simulated length are the same, and the undisturbed flow but for the
/// exponent of a power law.
bool has_same_channel(const Problem&, const Problem&);

/// Greatest relative change of any number.
double distance(const Problem&, const Problem&);

/// With the same laws in the same channel: whether the mesh and what flows into it are the same.
bool has_same_mesh(const Problem&, const Problem&);

/// Greatest change of any number that a kept state is carried over, and greatest change of the surface's stretch by it:
/// farther on the state may belong to another branch.
inline constexpr double max_change = 0.2, max_stretch_change = 0.06;

}  // namespace rheocyte

// How finely a state is resolved.
#pragma once
#include "fem/channel_mesh.h"

namespace rheocyte {

/// Of the meridian; the mesh of a duct follows from the problem, and from whether it is to see sharp rims.
struct Resolution {
  Subdivision subdivision;
  int degree = 4;
  bool operator==(const Resolution&) const = default;
};

}  // namespace rheocyte

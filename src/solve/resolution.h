// How finely a state is resolved.
#pragma once
#include "fem/channel_mesh.h"

namespace rheocyte {

/// Of the meridian; of a duct the degree alone, its mesh follows from the problem.
struct Resolution {
  Subdivision subdivision;
  int degree = 4;
  bool operator==(const Resolution&) const = default;
};

}  // namespace rheocyte

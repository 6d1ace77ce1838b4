// How finely a state is resolved.
#pragma once
#include "fem/channel_mesh.h"

namespace rheocyte {

struct Resolution {
  Subdivision subdivision;
  int degree = 4;
};

}  // namespace rheocyte

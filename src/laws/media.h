// What fills and bounds the channel's space: liquid, cell, and the cell's surface.
#pragma once
#include <initializer_list>

#include "laws/bulk.h"
#include "laws/cortex.h"
#include "laws/liquid.h"

namespace rheocyte {

/// Dimensionless, as the laws are.
struct Media {
  Liquid liquid = {};
  Bulk bulk = {};
  Cortex cortex = {};
};

/// The media at a compliance in (0, 1]: every modulus, tension and stiffness of the cell is divided by it.
inline Media media_at(Media media, double compliance) {
  for (double* stiffness :
       {&media.bulk.shear_modulus, &media.cortex.modulus, &media.cortex.tension, &media.cortex.bending})
    *stiffness /= compliance;
  return media;
}

}  // namespace rheocyte

// What fills and bounds the channel's space: liquid, cell, and the cell's surface.
#pragma once
#include <cmath>
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

/// Where the tension of the surroundings acts: inside a solid, on the surface of a pure shell (eq:axial-tension).
inline double& axial_tension(Media& media) {
  return media.bulk.law == BulkLaw::none ? media.cortex.axial_tension : media.bulk.axial_tension;
}

/// The media at a compliance in (0, 1]: every modulus, tension and stiffness of the cell is divided by it. The tension
/// of the surroundings is a load, as the flow's, and stays. The shape at rest comes with the compliance: a stiff cell
/// that keeps its rest shape would not be a sphere.
inline Media media_at(Media media, double compliance) {
  for (double* stiffness :
       {&media.bulk.shear_modulus, &media.cortex.modulus, &media.cortex.tension, &media.cortex.bending})
    *stiffness /= compliance;
  for (double* stretch : {&media.bulk.rest_stretch, &media.cortex.rest_stretch})
    *stretch = std::pow(*stretch, compliance);
  return media;
}

}  // namespace rheocyte

// A state's fields in the plane that the camera looks at, and the cell's whole surface, for a picture.
#pragma once
#include "duct/duct_space.h"
#include "fem/sampled_fields.h"
#include "laws/media.h"

namespace rheocyte {

/// About so many points of the mirror plane that the camera looks at, or of the nearest to it. Places are those of the
/// mesh.
SampledFields sample_duct_fields(const DuctSpace&, const Media&, const VectorXd& unknowns, const Scales&, Camera,
                                 int points);

}  // namespace rheocyte

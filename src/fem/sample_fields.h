// A state's fields for a picture, from its high-order elements.
#pragma once
#include "fem/discretisation.h"
#include "fem/sampled_fields.h"
#include "laws/media.h"

namespace rheocyte {

/// About so many points, spread evenly over the elements. Places are those of the mesh.
SampledFields sample_fields(const Discretisation&, const Media&, const VectorXd& unknowns, const Scales&, int points);

}  // namespace rheocyte

// The start of every computation in time: the sphere in the steady flow round it as if it were rigid.
#pragma once
#include "solve/newton.h"
#include "solve/path.h"

namespace rheocyte {

/// The same cell with an elastic interior, of modulus zero if it is a shell.
Problem with_elastic_interior(Problem);

/// The undeformed cell with the flow round it; `system` must be at rest.
Status flow_round_sphere(NonlinearSystem& system, const Media&, const NewtonOptions&, VectorXd& unknowns);

}  // namespace rheocyte

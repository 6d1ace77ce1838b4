#include "solve/geometry.h"

#include "solve/duct.h"
#include "solve/tube.h"

namespace rheocyte {

Geometry solver_geometry(const Problem& problem) {
  return is_duct(problem.section) ? duct_geometry(problem) : tube_geometry(problem);
}

}  // namespace rheocyte

#include "analytic/effective_modulus.h"

#include "numeric/no_value.h"

namespace rheocyte {

double effective_modulus(const Media& cell, double radius_ratio) {
  const Bulk& bulk = cell.bulk;
  const Cortex& cortex = cell.cortex;
  if (bulk.rest_stretch != 1) return no_value;
  const double E = bulk.law == BulkLaw::none ? 0 : 3 * bulk.shear_modulus;
  const double E2D = cortex.law == CortexLaw::none ? 0 : cortex.modulus;
  if (E == 0 && E2D == 0) return effective_modulus_of_drop(cortex.tension, cortex.bending, radius_ratio);
  return effective_modulus<double>({E, E2D, poisson_ratio(cortex), cortex.tension, cortex.bending, radius_ratio});
}

}  // namespace rheocyte

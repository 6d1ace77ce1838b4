// The cell of given projected area: published tables state the area of the deformed cell, not its radius at rest.
#pragma once
#include "solve/stationary.h"

namespace rheocyte::test {

/// A row of a published table.
struct TableRow {
  double area_um2, deformation, young_modulus_kPa;
};

struct CellOfArea {
  StationaryState state;
  double radius_um = 0;
  double area_error = 0;  ///< relative
};

/// Varies the radius at rest of `like` (secant steps) until the convexified area is `area_um2` to 1e-5, a thousandth of
/// the differences that are looked for. Ends early, unmatched, where the state does not converge.
CellOfArea cell_of_area(Problem like, double area_um2);

}  // namespace rheocyte::test

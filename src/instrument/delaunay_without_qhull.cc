// In place of infer/delaunay.cc in librheocyte_cell, which has no Qhull: published tables cannot be used there.
#include "case/user_error.h"
#include "infer/delaunay.h"

namespace rheocyte {

std::vector<std::array<std::int32_t, 3>> delaunay_triangles(std::span<const PlanePoint>) {
  throw UserError(
      "librheocyte_cell takes no published tables, whose points must be triangulated; give a table of rheocyte "
      "(grid_*.cbor).");
}

}  // namespace rheocyte

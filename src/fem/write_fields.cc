#include "fem/write_fields.h"

#include "fem/sampled_fields.h"
#include "fem/tensor_tangent.h"
#include "fem/vtu_file.h"

namespace rheocyte {

bool write_fields(const NodalFields& nodal, const std::string& path) {
  const int dim = nodal.dim(), p = nodal.degree();
  const MatrixXd equidistant = nodal.from_nodes(VectorXd::LinSpaced(p + 1, 0, 1)),
                 in_plane = dim == 2 ? sampling_grid(equidistant) : MatrixXd();
  VtuFile file(dim, p);
  for (int e = 0; e < nodal.elements(); ++e) {
    const MatrixXd at_nodes = nodal.of_element(e),
                   fields = dim == 2 ? in_plane * at_nodes : apply_in_each_direction(equidistant, at_nodes);
    file.add_element(fields.middleCols(nodal.x(), dim));
    file.add_field("velocity", fields.middleCols(nodal.v(), dim));
    file.add_field("velocity_relative", fields.middleCols(nodal.w(), dim));
    file.add_field("pressure", fields.col(nodal.pressure()));
    file.add_field("stress", fields.col(nodal.stress()));
    file.add_field("shear_stress", fields.col(nodal.shear_stress()));
    file.add_field("displacement", fields.middleCols(nodal.u(), dim));
    file.add_field("region", fields.col(nodal.region()));
  }
  return file.write(path);
}

}  // namespace rheocyte

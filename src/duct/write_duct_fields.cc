#include "duct/write_duct_fields.h"

#include "duct/duct_nodal_fields.h"
#include "fem/vtu_file.h"

namespace rheocyte {

bool write_duct_fields(const DuctSpace& space, const Media& media, const VectorXd& unknowns, const Scales& scales,
                       const std::string& path) {
  const int p = space.reference().degree();
  const MatrixXd equidistant = space.reference().lagrange(VectorXd::LinSpaced(p + 1, 0, 1));
  using Fields = DuctNodalFields;
  const Fields nodal(space, media, unknowns, scales);
  VtuFile file(3, p);
  for (int e = 0; e < int(space.elements().size()); ++e) {
    const MatrixXd fields = apply_in_each_direction(equidistant, nodal.of_element(e));
    file.add_element(fields.middleCols(Fields::x, 3));
    file.add_field("velocity", fields.middleCols(Fields::v, 3));
    file.add_field("velocity_relative", fields.middleCols(Fields::w, 3));
    file.add_field("pressure", fields.col(Fields::pressure));
    file.add_field("stress", fields.col(Fields::stress));
    file.add_field("shear_stress", fields.col(Fields::shear_stress));
    file.add_field("displacement", fields.middleCols(Fields::u, 3));
    file.add_field("region", fields.col(Fields::region));
  }
  return file.write(path);
}

}  // namespace rheocyte

#include "fem/write_fields.h"

#include "fem/nodal_fields.h"
#include "fem/sampled_fields.h"
#include "fem/vtu_file.h"

namespace rheocyte {

bool write_fields(const Discretisation& space, const Media& media, const VectorXd& unknowns, const Scales& scales,
                  const std::string& path) {
  const int p = space.reference().degree();
  const MatrixXd equidistant = sampling_grid(space.reference().lagrange(VectorXd::LinSpaced(p + 1, 0, 1)));
  using Fields = NodalFields;
  const Fields nodal(space, media, unknowns, scales);
  VtuFile file(2, p);
  for (int e = 0; e < int(space.elements().size()); ++e) {
    const MatrixXd fields = equidistant * nodal.of_element(e);
    file.add_element(fields.middleCols(Fields::x, 2));
    file.add_field("velocity", fields.middleCols(Fields::vx, 2));
    file.add_field("velocity_relative", fields.middleCols(Fields::wx, 2));
    file.add_field("pressure", fields.col(Fields::pressure));
    file.add_field("stress", fields.col(Fields::stress));
    file.add_field("shear_stress", fields.col(Fields::shear_stress));
    file.add_field("displacement", fields.middleCols(Fields::ux, 2));
    file.add_field("region", fields.col(Fields::region));
  }
  return file.write(path);
}

}  // namespace rheocyte

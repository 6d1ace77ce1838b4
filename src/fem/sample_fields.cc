#include "fem/sample_fields.h"

#include "fem/nodal_fields.h"

namespace rheocyte {

SampledFields sample_fields(const Discretisation& space, const Media& media, const VectorXd& unknowns,
                            const Scales& scales, int points) {
  using Fields = NodalFields;
  const int divisions = sampling_divisions(points, space.elements().size());
  const MatrixXd grid = sampling_grid(space.reference().lagrange(VectorXd::LinSpaced(divisions + 1, 0, 1)));
  const Eigen::Index of_element = grid.rows(), all = of_element * Eigen::Index(space.elements().size());
  const Fields nodal(space, media, unknowns, scales);
  SampledFields s;
  for (auto* vectors : {&s.point_um, &s.velocity_m_per_s, &s.displacement_um}) vectors->resize(all, 2);
  for (auto* numbers : {&s.pressure_Pa, &s.shear_rate_per_s, &s.stress_Pa, &s.stretch}) numbers->resize(all);
  for (int e = 0; e < int(space.elements().size()); ++e) {
    const Eigen::Index first = e * of_element;
    const Eigen::MatrixXf f = (grid * nodal.of_element(e)).cast<float>();
    s.point_um.middleRows(first, of_element) = f.middleCols(Fields::x, 2);
    s.velocity_m_per_s.middleRows(first, of_element) = f.middleCols(Fields::wx, 2);
    s.displacement_um.middleRows(first, of_element) = f.middleCols(Fields::ux, 2);
    s.pressure_Pa.segment(first, of_element) = f.col(Fields::pressure);
    s.shear_rate_per_s.segment(first, of_element) = f.col(Fields::rate);
    s.stress_Pa.segment(first, of_element) = f.col(Fields::stress);
    s.stretch.segment(first, of_element) = f.col(Fields::stretch);
    s.in_cell.insert(s.in_cell.end(), std::size_t(of_element), space.elements()[e].liquid ? 0 : 1);
    add_grid_triangles(std::uint32_t(first), divisions, s.triangles);
  }
  return s;
}

}  // namespace rheocyte

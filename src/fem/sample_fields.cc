#include "fem/sample_fields.h"

namespace rheocyte {

SampledFields sample_faces(const NodalFields& nodal, const std::vector<FaceInPlane>& faces, const VectorXd& across,
                           int points) {
  const int divisions = sampling_divisions(points, faces.size());
  const MatrixXd grid = sampling_grid(nodal.from_nodes(VectorXd::LinSpaced(divisions + 1, 0, 1)));
  const Eigen::Index of_face = grid.rows(), all = of_face * Eigen::Index(faces.size());
  SampledFields s;
  for (auto* vectors : {&s.point_um, &s.velocity_m_per_s, &s.displacement_um}) vectors->resize(all, 2);
  for (auto* numbers : {&s.pressure_Pa, &s.shear_rate_per_s, &s.stress_Pa, &s.stretch}) numbers->resize(all);
  for (std::size_t i = 0; i < faces.size(); ++i) {
    const Eigen::Index first = Eigen::Index(i) * of_face;
    const MatrixXd f = grid * nodal.of_element(faces[i].element)(faces[i].nodes, Eigen::all);
    const auto in_plane = [&](int column, SampledFields::Vectors& to) {
      to.block(first, 0, of_face, 1) = f.col(column).cast<float>();
      to.block(first, 1, of_face, 1) = (f.middleCols(column + 1, across.size()) * across).cast<float>();
    };
    in_plane(nodal.x(), s.point_um);
    in_plane(nodal.w(), s.velocity_m_per_s);
    in_plane(nodal.u(), s.displacement_um);
    s.pressure_Pa.segment(first, of_face) = f.col(nodal.pressure()).cast<float>();
    s.shear_rate_per_s.segment(first, of_face) = f.col(nodal.rate()).cast<float>();
    s.stress_Pa.segment(first, of_face) = f.col(nodal.stress()).cast<float>();
    s.stretch.segment(first, of_face) = f.col(nodal.stretch()).cast<float>();
    s.in_cell.insert(s.in_cell.end(), std::size_t(of_face), f(0, nodal.region()) > 0.5 ? 1 : 0);
    add_grid_triangles(std::uint32_t(first), divisions, s.triangles);
  }
  return s;
}

}  // namespace rheocyte

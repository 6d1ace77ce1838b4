#include "fem/nodal_fields.h"

#include <Eigen/Eigenvalues>
#include <cmath>

#include "fem/tensor_tangent.h"

namespace rheocyte {
namespace {

/// Of an elastic stress.
double von_mises(Tensor<double> sigma) {
  const double mean = sigma.trace() / 3;
  for (int i = 0; i < 3; ++i) sigma(i, i) -= mean;
  return std::sqrt(1.5) * sigma.norm();
}

/// Greatest principal stretch of a deformation gradient.
double max_stretch(const Tensor<double>& F) {
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> squares;
  squares.computeDirect((F.transpose() * F).eigen(), Eigen::EigenvaluesOnly);
  return std::sqrt(squares.eigenvalues()(2));
}

/// sqrt(2 D:D) of a velocity gradient.
double shear_rate(const Tensor<double>& L) { return (L + L.transpose()).norm() / std::sqrt(2.0); }

}  // namespace

VectorXd NodalFields::at_nodes(const VectorXd& at_points) const {
  return dim_ == 3 ? at_other_nodes<3>(to_nodes_, at_points) : at_other_nodes<2>(to_nodes_, at_points);
}

void NodalFields::add_liquid_stress(const std::vector<Tensor<double>>& gradients, MatrixXd& fields) const {
  VectorXd norm(gradients.size()), rates(gradients.size());
  for (int q = 0; q < norm.size(); ++q) {
    norm(q) = viscous_stress(media_.liquid, gradients[q]).norm() / std::sqrt(2.0);
    rates(q) = shear_rate(gradients[q]);
  }
  fields.col(shear_stress()) = scales_.stress_Pa * at_nodes(norm);
  fields.col(rate()) = at_nodes(rates) / scales_.time_s();
}

void NodalFields::add_cell_stress(const std::vector<Tensor<double>>& gradients, MatrixXd& fields) const {
  VectorXd norm(gradients.size()), stretches(gradients.size());
  for (int q = 0; q < norm.size(); ++q) {
    norm(q) = von_mises(elastic_stress(media_.bulk, gradients[q]));
    stretches(q) = max_stretch(gradients[q]);
  }
  fields.col(stress()) = scales_.stress_Pa * at_nodes(norm);
  fields.col(stretch()) = at_nodes(stretches);
}

MatrixXd NodalFields::of_element(int e) const {
  const ElementState state = state_of(e);
  const double um = scales_.length_um(), U = scales_.velocity_m_per_s;
  MatrixXd fields = MatrixXd::Zero(state.rest.rows(), columns());
  fields.col(region()).setConstant(state.liquid ? 0 : 1);
  fields.middleCols(u(), dim_) = um * state.displacement;
  fields.middleCols(x(), dim_) = um * state.rest + fields.middleCols(u(), dim_);
  fields.middleCols(w(), dim_) = U * state.velocity;
  fields.middleCols(v(), dim_) = fields.middleCols(w(), dim_);
  fields.col(v()).array() += U * cell_velocity_;
  fields.col(pressure()) = scales_.stress_Pa * (state.pressure.array() + (state.liquid ? 0 : at_rest_));
  if (state.gradients.empty()) return fields;
  state.liquid ? add_liquid_stress(state.gradients, fields) : add_cell_stress(state.gradients, fields);
  return fields;
}

}  // namespace rheocyte

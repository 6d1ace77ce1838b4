#include "duct/duct_flow.h"

#include <Eigen/LU>
#include <cassert>
#include <cmath>

#include "laws/developed_flow.h"
#include "laws/tensor.h"
#include "numeric/dense_solve.h"
#include "numeric/no_value.h"

namespace rheocyte {
namespace {

constexpr double same_point = 1e-9;
/// Change of the liquid's thinning in one step, and the least one.
constexpr double thinning_step = 0.2, min_thinning_step = 1e-3;
constexpr int iteration_limit = 25;
constexpr double tolerance = 1e-12;

/// Shear stress of the velocity's gradient.
template <class T>
Components<T, 2> shear_stress(const Liquid& liquid, const Components<T, 2>& gradient) {
  return gradient * viscosity(liquid, T(gradient.squaredNorm()));
}

}  // namespace

CrossSection::CrossSection(const DuctGeometry& geometry, int degree, Symmetry symmetry, int across)
    : reference_(degree) {
  const VectorXd& s = reference_.nodes_1d;
  const int n = degree + 1;
  const auto quadrilaterals = section_elements(symmetry, across);
  const auto point = [&](int e, int k) -> Eigen::Vector2d {
    return geometry.map(Part::end, quadrilaterals[e].on_cube(s(k % n), s(k / n), 1), 1).tail<2>();
  };
  const NodeNumbers numbers = number_nodes<2>(int(quadrilaterals.size()), reference_.nodes(), point);
  points_.resize(numbers.count);
  weights_.setZero(numbers.count);
  wall_.resize(numbers.count);
  for (std::size_t e = 0; e < quadrilaterals.size(); ++e) {
    Element element{numbers.of_element[e], {}, VectorXd(reference_.points())};
    Eigen::MatrixX2d X(reference_.nodes(), 2);
    for (int k = 0; k < reference_.nodes(); ++k) {
      X.row(k) = point(int(e), k).transpose();
      points_[element.nodes[k]] = X.row(k);
      wall_[element.nodes[k]] = geometry.is_wall({0, X(k, 0), X(k, 1)});
    }
    element.slope.fill(MatrixXd(reference_.points(), reference_.nodes()));
    for (int q = 0; q < reference_.points(); ++q) {
      Eigen::Matrix2d G;
      for (int k = 0; k < 2; ++k) G.col(k) = X.transpose() * reference_.shape.slope[k].row(q).transpose();
      const Eigen::Matrix2d inverse = G.inverse();
      element.weights(q) = reference_.weights(q) * G.determinant();
      for (int c = 0; c < 2; ++c) {
        element.slope[c].row(q) =
            inverse(0, c) * reference_.shape.slope[0].row(q) + inverse(1, c) * reference_.shape.slope[1].row(q);
      }
    }
    weights_(element.nodes) += reference_.shape.value.transpose() * element.weights;
    elements_.push_back(std::move(element));
  }
}

int CrossSection::node_at(const Eigen::Vector2d& at) const {
  for (std::size_t i = 0; i < points_.size(); ++i) {
    if ((points_[i] - at).norm() < same_point) return int(i);
  }
  assert(false);
  return -1;
}

bool CrossSection::improve(const Liquid& liquid, DuctFlow& flow) const {
  const int n = int(points_.size());
  for (int iteration = 0; iteration < iteration_limit; ++iteration) {
    // The last equation: mean speed 1.
    MatrixXd tangent = MatrixXd::Zero(n + 1, n + 1);
    VectorXd residual = VectorXd::Zero(n + 1);
    for (const Element& element : elements_) {
      const VectorXd local = flow.velocity(element.nodes);
      const VectorXd dy = element.slope[0] * local, dz = element.slope[1] * local;
      Eigen::MatrixX2d fluxes(dy.size(), 2);
      Eigen::MatrixX4d flux_slopes(dy.size(), 4);
      for (int q = 0; q < dy.size(); ++q) {
        const auto stress =
            shear_stress<Dual<double, 2>>(liquid, {Dual<double, 2>(dy(q), 0), Dual<double, 2>(dz(q), 1)});
        for (int c = 0; c < 2; ++c) {
          fluxes(q, c) = element.weights(q) * stress(c).value;
          for (int d = 0; d < 2; ++d) flux_slopes(q, 2 * c + d) = element.weights(q) * stress(c).slope(d);
        }
      }
      for (int c = 0; c < 2; ++c) {
        const auto test = element.slope[c].transpose();
        residual(element.nodes) += test * fluxes.col(c);
        for (int d = 0; d < 2; ++d) {
          const MatrixXd weighted = flux_slopes.col(2 * c + d).asDiagonal() * element.slope[d];
          tangent(element.nodes, element.nodes) += test * weighted;
        }
      }
    }
    residual.head(n) -= flow.pressure_gradient * weights_;
    residual(n) = weights_.sum() - weights_.dot(flow.velocity);
    tangent.col(n).head(n) = tangent.row(n).head(n).transpose() = -weights_;
    for (int i = 0; i < n; ++i) {
      if (!wall_[i]) continue;
      tangent.row(i).setZero();
      tangent(i, i) = 1;
      residual(i) = 0;
    }
    const VectorXd correction = solve_dense(tangent, -residual);
    if (!correction.allFinite()) return false;
    flow.velocity += correction.head(n);
    flow.pressure_gradient += correction(n);
    if (correction.lpNorm<Eigen::Infinity>() < tolerance * (1 + flow.pressure_gradient)) return true;
  }
  return false;
}

DuctFlow CrossSection::flow(const Liquid& liquid) const {
  const double way = thinning(liquid);
  DuctFlow flow{0, VectorXd::Zero(points_.size())};
  if (!improve(at_thinning(liquid, 0), flow)) flow.pressure_gradient = no_value;
  if (liquid.law == LiquidLaw::newtonian) {
    flow.pressure_gradient *= liquid.viscosity;
    return flow;
  }
  double reached = 0, step = way > 0 ? std::min(1.0, thinning_step / way) : 1;
  while (reached < 1) {
    const double fraction = 1 - reached - step < 1e-9 ? 1 : reached + step;
    DuctFlow trial = flow;
    if (improve(fraction == 1 ? liquid : at_thinning(liquid, fraction), trial)) {
      flow = trial;
      reached = fraction;
      continue;
    }
    step /= 2;
    if (step * way < min_thinning_step) {
      flow.pressure_gradient = no_value;
      return flow;
    }
  }
  return flow;
}

double CrossSection::gradient_at(const Liquid& liquid, double mean_speed) const {
  // In units of that speed, in which the flow has mean speed 1.
  return stress_at_rate(liquid, mean_speed) * flow(in_units_of_rate(liquid, mean_speed)).pressure_gradient;
}

}  // namespace rheocyte

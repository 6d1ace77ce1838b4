// How a weak form at points becomes residual and tangent of an element; included by this floor's sources only.
//
// Columns of an element come in groups with common shape functions. Each group feeds some inputs of the weak form; the
// outputs of the form, its fluxes, are tested with the nodes' functions and with the pressure modes.
#pragma once
#include <algorithm>
#include <limits>

#include "fem/element_integrals.h"

namespace rheocyte {

/// Which table of a column group feeds an input of the weak form: value or one of the derivatives.
enum class Part { value, d1, d2 };
struct Feed {
  int input;
  Part part;
};

inline const MatrixXd& table(const ShapeTable& shape, Part part) {
  return part == Part::value ? shape.value : part == Part::d1 ? shape.d1 : shape.d2;
}

/// A group of columns with common shape functions, and the inputs that it feeds.
struct ColumnGroup {
  const ShapeTable* shape;
  int first, count;
  std::vector<Feed> feeds;
};

/// The columns of an element of the stationary problem: positions, velocities, pressures. The pressure is the last
/// input of the form.
std::vector<ColumnGroup> column_groups(const ElementUnknowns&, const ReferenceElement&);

/// An element, and which of its columns feed which inputs of its weak form.
struct ElementQuadrature {
  const ReferenceElement& reference;
  const ElementUnknowns& element;
  std::vector<ColumnGroup> groups;
};

/// Fields at the quadrature points that the columns make, on top of the undeformed place.
inline MatrixXd gather_fields(const ElementQuadrature& quadrature, int inputs, const VectorXd& local) {
  const auto& [reference, element, groups] = quadrature;
  MatrixXd fields = MatrixXd::Zero(reference.points(), inputs);
  for (int q = 0; q < reference.points(); ++q) {
    const Place<double>& X = element.reference[q];
    fields.row(q).head<5>() << X.G(0, 0), X.G(0, 1), X.G(1, 0), X.G(1, 1), X.r;
  }
  for (const ColumnGroup& group : groups) {
    const auto coefficients = local.segment(group.first, group.count);
    for (const Feed& feed : group.feeds) fields.col(feed.input) += table(*group.shape, feed.part) * coefficients;
  }
  return fields;
}

/// Fluxes (points x outputs) and, if wanted, their derivatives (points x outputs*inputs), times the weights.
template <class Form, class MakeForm>
void evaluate_points(const MatrixXd& inputs, const VectorXd& weights, const MakeForm& form_at, Want want,
                     ElementSystem& system) {
  using Dual = ceres::Jet<double, Form::inputs>;
  const int points = int(inputs.rows());
  system.fluxes.resize(points, Form::outputs);
  system.flux_slopes.resize(points, Form::outputs * Form::inputs);
  for (int q = 0; q < points; ++q) {
    const Form form = form_at(q);
    if (want == Want::residual) {
      std::array<double, Form::inputs> f;
      for (int i = 0; i < Form::inputs; ++i) f[i] = inputs(q, i);
      const auto flux = form(f);
      for (int k = 0; k < Form::outputs; ++k) system.fluxes(q, k) = flux[k] * weights(q);
      continue;
    }
    std::array<Dual, Form::inputs> f;
    for (int i = 0; i < Form::inputs; ++i) f[i] = Dual(inputs(q, i), i);
    const auto flux = form(f);
    for (int k = 0; k < Form::outputs; ++k) {
      system.fluxes(q, k) = flux[k].a * weights(q);
      for (int i = 0; i < Form::inputs; ++i) {
        system.flux_slopes(q, k * Form::inputs + i) = flux[k].v(i) * weights(q);
      }
    }
  }
}

inline void test_residual(const ReferenceElement& reference, ElementSystem& system) {
  const int n = reference.nodes(), m = reference.pressures();
  system.residual.resize(2 * n + m);
  for (int c = 0; c < 2; ++c) {
    auto rows = system.residual.segment(c * n, n);
    rows.noalias() = reference.shape.value.transpose() * system.fluxes.col(3 * c);
    rows.noalias() += reference.shape.d1.transpose() * system.fluxes.col(3 * c + 1);
    rows.noalias() += reference.shape.d2.transpose() * system.fluxes.col(3 * c + 2);
  }
  system.residual.tail(m).noalias() = reference.pressure.value.transpose() * system.fluxes.col(6);
}

/// weighted(:, columns of the group) = d(flux k)/d(columns) at all points.
template <class Form>
void differentiate_flux(const ColumnGroup& group, int k, const ElementSystem& system, Eigen::Ref<MatrixXd> weighted) {
  bool first = true;
  for (const Feed& feed : group.feeds) {
    const auto slope = system.flux_slopes.col(k * Form::inputs + feed.input);
    const auto product = slope.asDiagonal() * table(*group.shape, feed.part);
    if (first) {
      weighted = product;
    } else {
      weighted += product;
    }
    first = false;
  }
}

/// Group by group, so that the derivatives of the fluxes stay in the cache until they are tested.
template <class Form>
void test_tangent(const ReferenceElement& reference, const std::vector<ColumnGroup>& groups, int columns,
                  ElementSystem& system) {
  const int n = reference.nodes(), m = reference.pressures(), points = reference.points();
  system.tangent.resize(2 * n + m, columns);
  for (const ColumnGroup& group : groups) {
    system.weighted.resize(3 * points, group.count);
    for (int c = 0; c < 2; ++c) {
      for (int k = 0; k < 3; ++k) {
        differentiate_flux<Form>(group, 3 * c + k, system, system.weighted.middleRows(k * points, points));
      }
      system.tangent.block(c * n, group.first, n, group.count).noalias() =
          reference.shape_stack.transpose() * system.weighted;
    }
    auto weighted = system.weighted.topRows(points);
    differentiate_flux<Form>(group, 6, system, weighted);
    system.tangent.block(2 * n, group.first, m, group.count).noalias() =
        reference.pressure.value.transpose() * weighted;
  }
}

/// Residual and, if wanted, tangent of an element from the fields at its quadrature points; `form_at(q)` makes the weak
/// form at point q.
template <class Form, class MakeForm>
void integrate_form(const ElementQuadrature& quadrature, const MatrixXd& inputs, const MakeForm& form_at, Want want,
                    ElementSystem& system) {
  const auto& [reference, element, groups] = quadrature;
  system.least_det = std::numeric_limits<double>::infinity();
  for (int q = 0; q < reference.points(); ++q) {
    const double det = inputs(q, 0) * inputs(q, 3) - inputs(q, 1) * inputs(q, 2);
    system.least_det = std::min(system.least_det, det / element.reference[q].det);
  }
  evaluate_points<Form>(inputs, reference.weights, form_at, want, system);
  test_residual(reference, system);
  if (want == Want::residual_and_tangent) {
    test_tangent<Form>(reference, groups, int(element.columns.size()), system);
  }
}

}  // namespace rheocyte

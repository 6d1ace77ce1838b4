// How a weak form at points becomes residual and tangent of an element of any dimension; included by this floor's
// sources only.
//
// Columns of an element come in groups with common shape functions. Each group feeds some fields of the weak form; the
// fluxes of the form are tested with the nodes' functions and with the pressure modes.
#pragma once
#include <algorithm>
#include <limits>
#include <type_traits>
#include <utility>

#include "fem/element_integrals.h"

namespace rheocyte {

/// A group of columns with common shape functions: one component of what `source` names.
template <int dim>
struct ColumnGroup {
  const ShapeTable<dim>* shape;
  int first, count;
  Source source;
  int component = 0;
};

/// A number among the fields of a weak form that a group feeds, and the part of the group's table that does so.
struct Feed {
  int input, part;
};

template <class Fields, int dim>
std::vector<Feed> feeds(const ColumnGroup<dim>& group) {
  static const std::vector<Input> inputs = inputs_of<Fields>();
  std::vector<Feed> result;
  for (int i = 0; i < int(inputs.size()); ++i) {
    if (inputs[i].source == group.source && inputs[i].component == group.component)
      result.push_back({i, inputs[i].part});
  }
  return result;
}

/// The columns of an element of the stationary problem: positions, velocities, pressures.
std::vector<ColumnGroup<2>> column_groups(const ElementUnknowns&, const ReferenceElement<2>&);

/// An element, and which of its columns feed which fields.
template <int dim>
struct ElementQuadrature {
  const ReferenceElement<dim>& reference;
  const std::vector<PointMap<double, dim>>& undeformed;  ///< at the quadrature points
  std::vector<ColumnGroup<dim>> groups;
};

/// Fields at the quadrature points that the columns make, on top of the undeformed map: points x numbers.
template <class Fields, int dim>
MatrixXd gather_fields(const ElementQuadrature<dim>& quadrature, const VectorXd& local) {
  const int points = quadrature.reference.points();
  MatrixXd numbers = MatrixXd::Zero(points, Fields::count);
  if constexpr (requires(Fields f) { f.map; } || std::is_same_v<Fields, MapFields<double, dim>>) {
    for (int q = 0; q < points; ++q) {
      MapFields<double, dim> X = quadrature.undeformed[q];
      int i = 0;
      X.visit([&](const Input&, double number) { numbers(q, i++) = number; });
    }
  }
  for (const ColumnGroup<dim>& group : quadrature.groups) {
    const auto coefficients = local.segment(group.first, group.count);
    for (const auto& [input, part] : feeds<Fields>(group)) numbers.col(input) += group.shape->part(part) * coefficients;
  }
  return numbers;
}

/// Fields at one point from gathered numbers; the structure may have less of them, the first ones.
template <class Fields>
Fields fields_at(const MatrixXd& numbers, int q) {
  return read_fields<Fields>([&](int i) { return numbers(q, i); });
}

/// One component of a field of (x, r) node by node, at the nodes of an element.
inline VectorXd component_at_nodes(const VectorXd& field, const std::vector<int>& nodes, int c) {
  VectorXd values(nodes.size());
  for (int k = 0; k < values.size(); ++k) values(k) = field(2 * nodes[k] + c);
  return values;
}

/// Numbers of the fields and of the fluxes of a weak form.
template <class Form>
constexpr int inputs = Form::template Fields<double>::count;
template <class Form>
constexpr int outputs = decltype(std::declval<Form>()(std::declval<typename Form::template Fields<double>>()))::count;

/// Fluxes (points x outputs) and, if wanted, their derivatives (points x outputs*inputs), times the weights.
template <class Form, class MakeForm>
void evaluate_points(const MatrixXd& numbers, const VectorXd& weights, const MakeForm& form_at, Want want,
                     ElementSystem& system) {
  constexpr int n = inputs<Form>;
  using Dual = ceres::Jet<double, n>;
  const int points = int(numbers.rows());
  system.fluxes.resize(points, outputs<Form>);
  system.flux_slopes.resize(points, outputs<Form> * n);
  for (int q = 0; q < points; ++q) {
    const Form form = form_at(q);
    int k = 0;
    if (want == Want::residual) {
      const auto fields = fields_at<typename Form::template Fields<double>>(numbers, q);
      form(fields).visit([&](double flux) { system.fluxes(q, k++) = flux * weights(q); });
      continue;
    }
    const auto fields =
        read_fields<typename Form::template Fields<Dual>>([&](int i) { return Dual(numbers(q, i), i); });
    form(fields).visit([&](const Dual& flux) {
      system.fluxes(q, k) = flux.a * weights(q);
      for (int i = 0; i < n; ++i) system.flux_slopes(q, k * n + i) = flux.v(i) * weights(q);
      ++k;
    });
  }
}

template <int dim>
void test_residual(const ReferenceElement<dim>& reference, ElementSystem& system) {
  const int n = reference.nodes(), m = reference.pressures(), points = reference.points();
  system.residual.resize(dim * n + m);
  for (int c = 0; c < dim; ++c) {
    const Eigen::Map<const VectorXd> stack(system.fluxes.col((1 + dim) * c).data(), (1 + dim) * points);
    system.residual.segment(c * n, n).noalias() = reference.shape_stack.transpose() * stack;
  }
  system.residual.tail(m).noalias() = reference.pressure.value.transpose() * system.fluxes.col((1 + dim) * dim);
}

/// weighted(:, columns of the group) = d(flux)/d(columns) at all points, for the flux whose slopes begin at a column.
template <int dim>
void differentiate_flux(const ColumnGroup<dim>& group, const std::vector<Feed>& feeds, int first_slope,
                        const ElementSystem& system, Eigen::Ref<MatrixXd> weighted) {
  bool first = true;
  if (feeds.empty()) weighted.setZero();
  for (const auto& [input, part] : feeds) {
    const auto slope = system.flux_slopes.col(first_slope + input);
    const auto product = slope.asDiagonal() * group.shape->part(part);
    if (first) {
      weighted = product;
    } else {
      weighted += product;
    }
    first = false;
  }
}

/// Group by group, so that the derivatives of the fluxes stay in the cache until they are tested.
template <class Form, int dim>
void test_tangent(const ReferenceElement<dim>& reference, const std::vector<ColumnGroup<dim>>& groups,
                  ElementSystem& system) {
  const int n = reference.nodes(), m = reference.pressures(), points = reference.points();
  int columns = 0;
  for (const ColumnGroup<dim>& group : groups) columns = std::max(columns, group.first + group.count);
  system.tangent.resize(dim * n + m, columns);
  for (const ColumnGroup<dim>& group : groups) {
    const std::vector<Feed> fed = feeds<typename Form::template Fields<double>>(group);
    system.weighted.resize((1 + dim) * points, group.count);
    for (int c = 0; c < dim; ++c) {
      for (int k = 0; k <= dim; ++k) {
        differentiate_flux(group, fed, ((1 + dim) * c + k) * inputs<Form>, system,
                           system.weighted.middleRows(k * points, points));
      }
      system.tangent.block(c * n, group.first, n, group.count).noalias() =
          reference.shape_stack.transpose() * system.weighted;
    }
    auto weighted = system.weighted.topRows(points);
    differentiate_flux(group, fed, (1 + dim) * dim * inputs<Form>, system, weighted);
    system.tangent.block(dim * n, group.first, m, group.count).noalias() =
        reference.pressure.value.transpose() * weighted;
  }
}

/// Least det of the map at the points relative to the undeformed one.
template <int dim>
double min_relative_det(const std::vector<PointMap<double, dim>>& undeformed, const MatrixXd& numbers) {
  double least = std::numeric_limits<double>::infinity();
  for (int q = 0; q < int(undeformed.size()); ++q) {
    const PointMap<double, dim> map(fields_at<MapFields<double, dim>>(numbers, q));
    least = std::min(least, map.det / undeformed[q].det);
  }
  return least;
}

/// Residual and, if wanted, tangent of an element from the fields at its quadrature points; `form_at(q)` makes the weak
/// form at point q.
template <class Form, int dim, class MakeForm>
void integrate_form(const ElementQuadrature<dim>& quadrature, const MatrixXd& numbers, const MakeForm& form_at,
                    Want want, ElementSystem& system) {
  const auto& [reference, undeformed, groups] = quadrature;
  using Fields = typename Form::template Fields<double>;
  if constexpr (requires(Fields f) { f.map; }) system.min_det = min_relative_det(undeformed, numbers);
  evaluate_points<Form>(numbers, reference.weights, form_at, want, system);
  test_residual(reference, system);
  if (want == Want::residual_and_tangent) test_tangent<Form>(reference, groups, system);
}

}  // namespace rheocyte

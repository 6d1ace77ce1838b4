// How a weak form at points becomes residual and tangent of an element of any dimension; included by this floor's
// sources only.
//
// Columns of an element come in groups with common shape functions. Each group feeds some fields of the weak form; the
// fluxes of the form are tested with the nodes' functions and with the pressure modes.
#pragma once
#include <algorithm>
#include <array>
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

/// Fluxes (points x outputs) and, if requested, their derivatives (points x outputs*inputs), times the weights.
template <class Form, class MakeForm>
void evaluate_points(const MatrixXd& numbers, const VectorXd& weights, const MakeForm& form_at, Want want,
                     ElementSystem& system) {
  constexpr int n = inputs<Form>;
  using Number = Dual<double, n>;
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
        read_fields<typename Form::template Fields<Number>>([&](int i) { return Number(numbers(q, i), i); });
    form(fields).visit([&](const Number& flux) {
      system.fluxes(q, k) = flux.value * weights(q);
      for (int i = 0; i < n; ++i) system.flux_slopes(q, k * n + i) = flux.slope(i) * weights(q);
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

/// sums <- P^T C P with products P of functions of one coordinate and `coefficients` C at the points: each coordinate
/// is summed by itself (docs/theory.md, eq:sums-2d).
inline void sum_by_directions(const MatrixXd& products, ElementSystem& system) {
  system.weighted.noalias() = system.coefficients * products;
  system.sums.noalias() = products.transpose() * system.weighted;
}

/// block(i, j) = sum_q sum_kl (part k of phi_i)(q) C_kl(q) (part l of phi_j)(q) with the slopes C of the fluxes of one
/// component.
inline void test_nodes_with_nodes(const ReferenceElement<2>& reference, const std::vector<Feed>& feeds, int first_slope,
                                  int inputs, ElementSystem& system, Eigen::Ref<MatrixXd> block) {
  const Eigen::Index m = reference.points_1d.size(), n = reference.degree() + 1;
  system.coefficients.setZero(4 * m, 4 * m);
  for (int k = 0; k <= 2; ++k) {
    for (const auto& [input, part] : feeds) {
      const auto slope = system.flux_slopes.col(first_slope + k * inputs + input).reshaped(m, m);
      system.coefficients.block(m * ((k == 1) + 2 * (part == 1)), m * ((k == 2) + 2 * (part == 2)), m, m) = slope;
    }
  }
  sum_by_directions(reference.products_1d, system);  // (i1, j1) x (i2, j2)
  for (Eigen::Index j = 0; j < n * n; ++j) {
    for (Eigen::Index i2 = 0; i2 < n; ++i2)
      block.col(j).segment(n * i2, n) = system.sums.col(i2 + n * (j / n)).segment(n * (j % n), n);
  }
}

/// block(i, j) = sum_q sum_k (part k of phi_i)(q) C_k(q) psi_j(q) with the pressure modes psi, where C_k is a column of
/// the slopes, -1: none.
inline void test_nodes_with_modes(const ReferenceElement<2>& reference, const std::array<int, 3>& slopes,
                                  ElementSystem& system, Eigen::Ref<MatrixXd> block) {
  const Eigen::Index m = reference.points_1d.size(), n = reference.degree() + 1;
  system.coefficients.setZero(2 * m, 2 * m);
  for (int k = 0; k <= 2; ++k) {
    if (slopes[k] < 0) continue;
    system.coefficients.block(m * (k == 1), m * (k == 2), m, m) = system.flux_slopes.col(slopes[k]).reshaped(m, m);
  }
  sum_by_directions(reference.mode_products_1d, system);  // (i1, j1) x (i2, j2)
  for (int total = 0, j = 0; total < reference.degree(); ++total) {
    for (int j2 = 0; j2 <= total; ++j2, ++j) {
      const auto of_mode = system.sums.block(n * (total - j2), n * j2, n, n);
      block.col(j) = of_mode.reshaped();
    }
  }
}

/// The columns of one group in the rows of the nodes.
template <class Form>
void test_with_nodes(const ReferenceElement<2>& reference, const ColumnGroup<2>& group, const std::vector<Feed>& fed,
                     ElementSystem& system) {
  const int n = reference.nodes(), points = reference.points();
  for (int c = 0; c < 2; ++c) {
    const int first_slope = 3 * c * inputs<Form>;
    auto block = system.tangent.block(c * n, group.first, n, group.count);
    if (group.shape == &reference.shape) {
      test_nodes_with_nodes(reference, fed, first_slope, inputs<Form>, system, block);
    } else if (group.shape == &reference.pressure) {
      const int p = first_slope + fed.front().input;
      test_nodes_with_modes(reference, {p, p + inputs<Form>, p + 2 * inputs<Form>}, system, block);
    } else {
      system.weighted.resize(3 * points, group.count);
      for (int k = 0; k <= 2; ++k)
        differentiate_flux(group, fed, first_slope + k * inputs<Form>, system,
                           system.weighted.middleRows(k * points, points));
      block.noalias() = reference.shape_stack.transpose() * system.weighted;
    }
  }
}

/// The columns of one group in the rows of the pressure modes.
template <class Form>
void test_with_modes(const ReferenceElement<2>& reference, const ColumnGroup<2>& group, const std::vector<Feed>& fed,
                     ElementSystem& system) {
  const int first_slope = 6 * inputs<Form>;
  auto block = system.tangent.block(2 * reference.nodes(), group.first, reference.pressures(), group.count);
  if (group.shape == &reference.shape) {
    std::array<int, 3> slopes{-1, -1, -1};
    for (const auto& [input, part] : fed) slopes[part] = first_slope + input;
    MatrixXd transposed(group.count, reference.pressures());
    test_nodes_with_modes(reference, slopes, system, transposed);
    block = transposed.transpose();
  } else {
    system.weighted.resize(reference.points(), group.count);
    differentiate_flux(group, fed, first_slope, system, system.weighted);
    block.noalias() = reference.pressure.value.transpose() * system.weighted;
  }
}

template <class Form>
void test_tangent(const ReferenceElement<2>& reference, const std::vector<ColumnGroup<2>>& groups,
                  ElementSystem& system) {
  int columns = 0;
  for (const ColumnGroup<2>& group : groups) columns = std::max(columns, group.first + group.count);
  system.tangent.resize(2 * reference.nodes() + reference.pressures(), columns);
  for (const ColumnGroup<2>& group : groups) {
    const std::vector<Feed> fed = feeds<typename Form::template Fields<double>>(group);
    test_with_nodes<Form>(reference, group, fed, system);
    test_with_modes<Form>(reference, group, fed, system);
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

/// Residual and, if requested, tangent of an element from the fields at its quadrature points; `form_at(q)` makes the
/// weak form at point q.
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

#include "duct/duct_integrals.h"

#include "fem/element_quadrature.h"
#include "laws/moving_form.h"

namespace rheocyte {
namespace {

using Cell = CellFields<double, 3>;
using Liquids = LiquidFields<double, 3>;

/// Which number of the fields is a part of a component of a source; -1: none.
template <class Fields>
int input_of(Source source, int component, int part) {
  static const std::vector<Input> inputs = inputs_of<Fields>();
  for (int i = 0; i < int(inputs.size()); ++i) {
    if (inputs[i].source == source && inputs[i].component == component && inputs[i].part == part) return i;
  }
  return -1;
}

/// Where rows stand in a matrix; -1: nowhere.
std::vector<int> places(const int* unknowns, int count, const std::vector<int>& place) {
  std::vector<int> rows(count);
  for (int i = 0; i < count; ++i) rows[i] = unknowns[i] < 0 ? -1 : place[unknowns[i]];
  return rows;
}

/// Adds the block of one pair of components.
void scatter(const TensorTangent& block, int nodes_1d, const std::vector<int>& rows, const Slot* columns,
             const std::vector<int>& place, Eigen::MatrixXf& matrix) {
  const int n = nodes_1d;
  for (int j = 0; j < n * n * n; ++j) {
    const Slot& slot = columns[j];
    if (slot.unknown < 0 || slot.factor == 0) continue;
    float* column = matrix.col(place[slot.unknown]).data();
    const auto factor = float(slot.factor);
    for (int i3 = 0; i3 < n; ++i3) {
      for (int i2 = 0; i2 < n; ++i2) {
        const float* run = block.run(i2, i3, j % n, j / n % n, j / (n * n));
        const int* row = rows.data() + n * (i2 + n * i3);
        for (int i1 = 0; i1 < n; ++i1) {
          if (row[i1] >= 0) column[row[i1]] += factor * run[i1];
        }
      }
    }
  }
}

}  // namespace

VectorXd values_of(const std::vector<Slot>& slots, const VectorXd& unknowns) {
  VectorXd values(slots.size());
  for (int i = 0; i < values.size(); ++i) values(i) = slots[i].value(unknowns);
  return values;
}

MatrixXd points_of_nodes(const DuctSpace& space, int e, const VectorXd& unknowns) {
  const HexahedronUnknowns& self = space.elements()[e];
  const auto& nodes = space.nodes().of_element[e];
  MatrixXd x(nodes.size(), 3);
  for (int k = 0; k < x.rows(); ++k) x.row(k) = space.node_points()[nodes[k]].transpose();
  if (self.moves) x += values_of(self.displacement, unknowns).reshaped(x.rows(), 3);
  return x;
}

namespace {

template <class Fields>
MatrixXd numbers_at_points(const Hexahedron& at, const VectorXd& unknowns) {
  const auto& [space, element, e, self, spin] = at;
  const int n = space.reference().nodes();
  MatrixXd numbers = MatrixXd::Zero(space.reference().points(), Fields::count);
  const auto add = [&](Source source, const MatrixXd& nodal) {
    for (int part = 0; part <= 3; ++part) {
      if (input_of<Fields>(source, 0, part) < 0) continue;
      const MatrixXd values = element.at_points(part, nodal);
      for (int c = 0; c < 3; ++c) numbers.col(input_of<Fields>(source, c, part)) = values.col(c);
    }
  };
  add(Source::position, points_of_nodes(space, e, unknowns));
  if (const int p = input_of<Fields>(Source::pressure, 0, 0); p >= 0)
    numbers.col(p) = space.reference().pressure.value * values_of(self.pressure, unknowns);
  if (input_of<Fields>(Source::velocity, 0, 1) >= 0)
    add(Source::velocity, values_of(self.velocity, unknowns).reshaped(n, 3));
  return numbers;
}

}  // namespace

template <class Fields>
MatrixXd numbers_at_points(const DuctSpace& space, const TensorElement& element, int e, const VectorXd& unknowns) {
  return numbers_at_points<Fields>({space, element, e, space.elements()[e]}, unknowns);
}

template MatrixXd numbers_at_points<MapFields<double, 3>>(const DuctSpace&, const TensorElement&, int, const VectorXd&);
template MatrixXd numbers_at_points<Cell>(const DuctSpace&, const TensorElement&, int, const VectorXd&);
template MatrixXd numbers_at_points<Liquids>(const DuctSpace&, const TensorElement&, int, const VectorXd&);

namespace {

/// Fluxes at the points of an element of the cell, at rest or on its way.
void evaluate_cell(const Bulk& bulk, const Hexahedron& at, Want want, ElementSystem& points) {
  const HexahedronUnknowns& self = at.self;
  const VectorXd& weights = at.space.reference().weights;
  if (self.history.empty()) {
    const auto form_at = [&](int q) { return CellPoint<3>{bulk, self.undeformed[q]}; };
    return evaluate_points<CellPoint<3>>(points.numbers, weights, form_at, want, points);
  }
  const auto form_at = [&](int q) {
    return MovingCellPoint<3>{
        .law = bulk, .undeformed = self.undeformed[q], .rate = self.rate, .history = self.history[q].at_spin(at.spin)};
  };
  evaluate_points<MovingCellPoint<3>>(points.numbers, weights, form_at, want, points);
}

}  // namespace

VectorXd integrate_hexahedron(const Hexahedron& at, const Media& media, const VectorXd& unknowns, Want want,
                              ElementSystem& points) {
  const auto& [space, element, e, self, spin] = at;
  const ReferenceElement<3>& reference = space.reference();
  if (self.liquid) {
    points.numbers = numbers_at_points<Liquids>(at, unknowns);
    evaluate_points<LiquidPoint<3>>(
        points.numbers, reference.weights, [&](int) { return LiquidPoint<3>{media.liquid}; }, want, points);
  } else {
    points.numbers = numbers_at_points<Cell>(at, unknowns);
    evaluate_cell(media.bulk, at, want, points);
  }
  points.min_det = min_relative_det(self.undeformed, points.numbers);
  const int n = reference.nodes(), m = reference.pressures();
  VectorXd residual = VectorXd::Zero(3 * n + m);
  for (int k = 0; k <= 3; ++k) {
    if (k == 0 && media.liquid.reynolds == 0) continue;
    MatrixXd fluxes(reference.points(), 3);
    for (int c = 0; c < 3; ++c) fluxes.col(c) = points.fluxes.col(4 * c + k);
    const MatrixXd tested = element.tested(k, fluxes);  // components x nodes
    for (int c = 0; c < 3; ++c) residual.segment(c * n, n) += tested.row(c).transpose();
  }
  residual.tail(m) = reference.pressure.value.transpose() * points.fluxes.col(12);
  return residual;
}

/// Adds what the pressure modes do to the momentum a, and the displacements or velocities b to the tests of pressures.
template <class Fields>
void HexahedronTangent::add_pressures(const HexahedronUnknowns& self, Workspace& workspace) const {
  const std::vector<int>& place = workspace.place;
  Eigen::MatrixXf& matrix = workspace.matrix;
  const MatrixXd& modes = element_modes_;
  const int n = int(self.rows.size() - self.pressure.size()) / 3, m = int(self.pressure.size());
  const auto slope = [&](int flux, int input) {
    return workspace.element.flux_slopes.col(flux * Fields::count + input);
  };
  const auto tested = [&](const auto& coefficients) {
    MatrixXd sum = MatrixXd::Zero(m, n);
    for (int k = 1; k <= 3; ++k) sum += element_.tested(k, coefficients(k).asDiagonal() * modes);
    return sum;
  };
  const std::vector<int> rows = places(self.rows.data(), int(self.rows.size()), place);
  const int p = input_of<Fields>(Source::pressure, 0, 0);
  for (int a = 0; a < 3; ++a) {
    const MatrixXd block = tested([&](int k) { return slope(4 * a + k, p); });
    for (int j = 0; j < m; ++j) {
      float* column = matrix.col(place[self.pressure[j].unknown]).data();
      for (int i = 0; i < n; ++i) {
        if (rows[a * n + i] >= 0) column[rows[a * n + i]] += float(block(j, i));
      }
    }
  }
  const auto add_rows = [&](Source source, const std::vector<Slot>& columns) {
    for (int b = 0; b < 3 && !columns.empty(); ++b) {
      const MatrixXd block = tested([&](int l) { return slope(12, input_of<Fields>(source, b, l)); });
      for (int j = 0; j < n; ++j) {
        const Slot& slot = columns[b * n + j];
        if (slot.unknown < 0) continue;
        float* column = matrix.col(place[slot.unknown]).data();
        for (int i = 0; i < m; ++i) column[rows[3 * n + i]] += float(slot.factor * block(i, j));
      }
    }
  };
  add_rows(Source::position, self.displacement);
  if (self.liquid) add_rows(Source::velocity, self.velocity);
}

template <class Fields>
void HexahedronTangent::add_fields(const HexahedronUnknowns& self, bool has_inertia, Workspace& workspace) const {
  const std::vector<int>& place = workspace.place;
  const int n = int(self.rows.size() - self.pressure.size()) / 3;
  const auto add = [&](Source source, const std::vector<Slot>& columns, int a, int b) {
    TensorTangent::Coefficients coefficients{};
    for (int k = has_inertia ? 0 : 1; k <= 3; ++k) {
      for (int l = has_inertia ? 0 : 1; l <= 3; ++l) {
        const int input = input_of<Fields>(source, b, l);
        if (input >= 0)
          coefficients[k][l] = workspace.element.flux_slopes.col((4 * a + k) * Fields::count + input).data();
      }
    }
    workspace.tensor.integrate(element_, coefficients);
    scatter(workspace.tensor, element_.nodes_1d(), places(self.rows.data() + a * n, n, place), columns.data() + b * n,
            place, workspace.matrix);
  };
  for (int a = 0; a < 3; ++a) {
    for (int b = 0; b < 3; ++b) {
      if (self.moves) add(Source::position, self.displacement, a, b);
      if (self.liquid) add(Source::velocity, self.velocity, a, b);
    }
  }
  add_pressures<Fields>(self, workspace);
}

void HexahedronTangent::add(const HexahedronUnknowns& self, bool has_inertia, Workspace& workspace) const {
  if (self.liquid) {
    add_fields<Liquids>(self, has_inertia, workspace);
  } else {
    add_fields<Cell>(self, false, workspace);
  }
}

}  // namespace rheocyte

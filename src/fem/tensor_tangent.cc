#include "fem/tensor_tangent.h"

namespace rheocyte {
namespace {

using ConstMap = Eigen::Map<const MatrixXd>;
using ConstMapF = Eigen::Map<const Eigen::MatrixXf>;

/// Applies a table (out x in) to the first index of an array, which becomes the last one: rest x out.
MatrixXd rotate(const MatrixXd& table, const MatrixXd& array) {
  const ConstMap first(array.data(), table.cols(), array.size() / table.cols());
  return first.transpose() * table.transpose();
}

}  // namespace

MatrixXd apply_in_directions(const std::array<MatrixXd, 3>& tables, const MatrixXd& functions) {
  MatrixXd array = rotate(tables[2], rotate(tables[1], rotate(tables[0], functions)));  // (column, out out out)
  array.resize(functions.cols(), tables[0].rows() * tables[1].rows() * tables[2].rows());
  return array.transpose();
}

MatrixXd apply_in_each_direction(const MatrixXd& table, const MatrixXd& functions) {
  return apply_in_directions({table, table, table}, functions);
}

TensorElement::TensorElement(const ReferenceElement<3>& reference)
    : nodes_(int(reference.nodes_1d.size())), points_(int(reference.points_1d.size())) {
  shape_ = {reference.lagrange(reference.points_1d), reference.lagrange_derivative(reference.points_1d)};
  for (int s = 0; s < 2; ++s) transposed_[s] = shape_[s].transpose();
  stacked_products_.resize(4 * points_, nodes_ * nodes_);
  for (int s = 0; s < 2; ++s) {
    for (int t = 0; t < 2; ++t) {
      Eigen::MatrixXf& product = products_[s][t];
      product.resize(points_, nodes_ * nodes_);
      for (int j = 0; j < nodes_; ++j)
        product.middleCols(j * nodes_, nodes_) = (shape_[t].col(j).asDiagonal() * shape_[s]).cast<float>();
      stacked_products_.middleRows((s + 2 * t) * points_, points_) = product;
    }
  }
}

MatrixXd TensorElement::at_points(int part, const MatrixXd& nodal) const {
  MatrixXd array = rotate(shape_[part == 1], nodal);
  array = rotate(shape_[part == 2], array);
  array = rotate(shape_[part == 3], array);  // (column, q1 q2 q3)
  array.resize(nodal.cols(), points_ * points_ * points_);
  return array.transpose();
}

MatrixXd TensorElement::tested(int part, const MatrixXd& at_points) const {
  MatrixXd array = rotate(transposed_[part == 1], at_points);
  array = rotate(transposed_[part == 2], array);
  array = rotate(transposed_[part == 3], array);
  array.resize(at_points.cols(), nodes_ * nodes_ * nodes_);
  return array;
}

/// sums(i3 j3; q1 q2) over q3 for rows and columns of a kind: derived in the first direction (1), in the second (2), or
/// neither (0), which a value (part 0) and a derivative in the third one (part 3) are.
void TensorTangent::sum_third(const TensorElement& element, const Coefficients& C, int row_kind, int column_kind,
                              Eigen::MatrixXf& sums) {
  const int n = element.nodes_, m = element.points_;
  sums.setZero(n * n, m * m);
  const auto parts = [](int kind) { return kind == 0 ? std::array{0, 3} : std::array{kind, -1}; };
  for (const int k : parts(row_kind)) {
    for (const int l : parts(column_kind)) {
      if (k < 0 || l < 0 || !C[k][l]) continue;
      const ConstMap coefficients(C[k][l], m * m, m);
      sums.noalias() += element.products_[k == 3][l == 3].transpose() * coefficients.cast<float>().transpose();
    }
  }
}

void TensorTangent::integrate(const TensorElement& element, const Coefficients& C) {
  const int n = element.nodes_, m = element.points_, nn = n * n;
  nodes_ = n;
  // second(i2 j2; i3 j3, q1), one block after the other for the derivatives in the first direction: none, of the rows,
  // of the columns, of both.
  second_.setZero(nn, 4 * Eigen::Index(nn) * m);
  for (int row_kind = 0; row_kind < 3; ++row_kind) {
    for (int column_kind = 0; column_kind < 3; ++column_kind) {
      sum_third(element, C, row_kind, column_kind, third_);
      const ConstMapF by_second(third_.data(), Eigen::Index(nn) * m, m);
      const int block = (row_kind == 1) + 2 * (column_kind == 1);
      second_.middleCols(block * Eigen::Index(nn) * m, Eigen::Index(nn) * m).noalias() +=
          element.products_[row_kind == 2][column_kind == 2].transpose() * by_second.transpose();
    }
  }
  const ConstMapF by_first(second_.data(), Eigen::Index(nn) * nn, 4 * m);
  result_.resize(nn, Eigen::Index(nn) * nn);
  result_.noalias() = element.stacked_products_.transpose() * by_first.transpose();
}

}  // namespace rheocyte

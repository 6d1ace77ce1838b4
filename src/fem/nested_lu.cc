#include "fem/nested_lu.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "fem/nested_order.h"
#include "fem/triangular_solve.h"

namespace rheocyte {

using Eigen::MatrixXd;
using Eigen::VectorXd;

void set_neighbours(std::vector<std::vector<int>> nodes, std::size_t nodes_of_face,
                    std::vector<CoupledUnknowns>& elements) {
  for (auto& of_element : nodes) std::sort(of_element.begin(), of_element.end());
  for (std::size_t e = 0; e < nodes.size(); ++e) {
    for (std::size_t f = 0; f < e; ++f) {
      std::vector<int> common;
      std::set_intersection(nodes[e].begin(), nodes[e].end(), nodes[f].begin(), nodes[f].end(),
                            std::back_inserter(common));
      if (common.size() < nodes_of_face) continue;
      elements[e].neighbours.push_back(int(f));
      elements[f].neighbours.push_back(int(e));
    }
  }
}

template <class Scalar>
void NestedLU<Scalar>::append(int in_part, int in_whole, std::vector<Run>& runs) {
  const bool goes_on = !runs.empty() && in_part == runs.back().in_part + runs.back().size &&
                       in_whole == runs.back().in_whole + runs.back().size;
  if (!goes_on) runs.push_back({in_part, in_whole, 0});
  ++runs.back().size;
}

template <class Scalar>
NestedLU<Scalar>::NestedLU(int unknowns, const std::vector<CoupledUnknowns>& elements) {
  std::vector<int> place(unknowns, -1);
  for (const Subdomain& subdomain : nested_order(unknowns, elements)) {
    Front& front = fronts_.emplace_back();
    front.unknowns = subdomain.eliminated;
    front.eliminated = int(front.unknowns.size());
    front.unknowns.insert(front.unknowns.end(), subdomain.remaining.begin(), subdomain.remaining.end());
    front.parts = subdomain.parts;
    flops_ += elimination_flops(front.eliminated, double(subdomain.remaining.size()));
    if (front.parts[0] < 0) continue;
    for (int i = 0; i < int(front.unknowns.size()); ++i) place[front.unknowns[i]] = i;
    for (int side = 0; side < 2; ++side) {
      Front& part = fronts_[front.parts[side]];
      part.whole = int(fronts_.size()) - 1;
      for (int i = part.eliminated; i < int(part.unknowns.size()); ++i) {
        const int at = place[part.unknowns[i]];
        const bool ends = at < front.eliminated;
        append(i - part.eliminated, ends ? at : at - front.eliminated, ends ? front.ended[side] : front.left[side]);
      }
    }
  }
  // Each subdomain after its parts, from the whole downwards.
  std::vector<int> left{int(fronts_.size()) - 1};
  while (!left.empty()) {
    const int subdomain = left.back();
    left.pop_back();
    const std::array<int, 2>& parts = fronts_[subdomain].parts;
    if (parts[0] < 0) {
      elements_.push_back(subdomain);
    } else {
      left.insert(left.end(), parts.begin(), parts.end());
    }
  }
}

template <class Scalar>
bool NestedLU<Scalar>::eliminate(Front& front, Blocks matrix, const std::atomic<bool>* stop) {
  const auto is_stopped = [stop] { return stop && *stop; };
  front.schur = std::move(matrix.rest);
  if (front.eliminated == 0) return true;
  if (is_stopped()) return false;
  front.lu.compute(matrix.own);
  front.rows = std::move(matrix.rows);
  front.solved_columns.resizeLike(matrix.columns);
  front.solved_columns(front.lu.permutationP().indices(), Eigen::all) =
      matrix.columns;  // Eigen's product goes row by row
  if (is_stopped()) return false;
  solve_triangular(front.lu.matrixLU(), front.solved_columns);
  if (is_stopped()) return false;
  front.schur.noalias() -= front.rows * front.solved_columns;
  return !is_stopped();
}

template <class Scalar>
bool NestedLU<Scalar>::condense(int element, const Matrix& matrix, const std::atomic<bool>* stop) {
  const Eigen::Index f = fronts_[element].eliminated, o = matrix.rows() - f;
  Blocks blocks{matrix.topLeftCorner(f, f), matrix.topRightCorner(f, o), matrix.bottomLeftCorner(o, f),
                matrix.bottomRightCorner(o, o)};
  if (!eliminate(fronts_[element], std::move(blocks), stop)) return false;
  for (int at = element; fronts_[at].whole >= 0; at = fronts_[at].whole) {
    Front& whole = fronts_[fronts_[at].whole];
    fronts_[at].waits = true;
    if (!fronts_[whole.parts[0]].waits || !fronts_[whole.parts[1]].waits) return true;
    if (!eliminate(whole, joined(whole), stop)) return false;
  }
  return true;
}

/// The matrix of a subdomain from those of its parts, which are given up.
template <class Scalar>
typename NestedLU<Scalar>::Blocks NestedLU<Scalar>::joined(const Front& whole) {
  const Eigen::Index f = whole.eliminated, o = Eigen::Index(whole.unknowns.size()) - f;
  Blocks sum{Matrix::Zero(f, f), Matrix::Zero(f, o), Matrix::Zero(o, f), Matrix::Zero(o, o)};
  for (int side = 0; side < 2; ++side) {
    Front& part = fronts_[whole.parts[side]];
    const auto add = [&](const std::vector<Run>& rows, const std::vector<Run>& columns, Matrix& to) {
      for (const Run& across : columns)
        for (int j = 0; j < across.size; ++j)
          for (const Run& down : rows)
            to.col(across.in_whole + j).segment(down.in_whole, down.size) +=
                part.schur.col(across.in_part + j).segment(down.in_part, down.size);
    };
    const std::vector<Run>&ended = whole.ended[side], &left = whole.left[side];
    add(ended, ended, sum.own);
    add(ended, left, sum.columns);
    add(left, ended, sum.rows);
    add(left, left, sum.rest);
    part.schur.resize(0, 0);
    part.waits = false;
  }
  return sum;
}

// What is not finite anywhere makes all that is joined with it NaN, up to the pivots of the whole.
template <class Scalar>
bool NestedLU<Scalar>::is_regular() const {
  const Front& whole = fronts_.back();
  if (whole.eliminated == 0) return true;
  const auto pivots = whole.lu.matrixLU().diagonal().array().abs();
  return pivots.allFinite() && pivots.minCoeff() > 0;
}

/// Each column is scaled by itself.
template <class Scalar>
template <int columns>
Eigen::Matrix<double, Eigen::Dynamic, columns> NestedLU<Scalar>::substituted(
    const Eigen::Matrix<double, Eigen::Dynamic, columns>& rhs) const {
  using Columns = Eigen::Matrix<Scalar, Eigen::Dynamic, columns>;
  // Residuals far below the smallest number of single precision are corrected as well as others.
  const Eigen::RowVectorXd size = rhs.cwiseAbs().colwise().maxCoeff();
  if (!size.allFinite()) return rhs;
  const Eigen::RowVectorXd divisor = (size.array() == 0).select(1, size.array());
  Columns x = (rhs.array().rowwise() / divisor.array()).template cast<Scalar>();
  for (const Front& front : fronts_) {
    if (front.eliminated == 0) continue;
    const std::vector<int>& all = front.unknowns;
    const std::vector<int> first(all.begin(), all.begin() + front.eliminated),
        rest(all.begin() + front.eliminated, all.end());
    const Columns y = front.lu.solve(Columns(x(first, Eigen::all)));
    x(first, Eigen::all) = y;
    if (!rest.empty()) x(rest, Eigen::all) -= front.rows * y;
  }
  for (auto front = fronts_.rbegin(); front != fronts_.rend(); ++front) {
    const std::vector<int>& all = front->unknowns;
    const std::vector<int> first(all.begin(), all.begin() + front->eliminated),
        rest(all.begin() + front->eliminated, all.end());
    if (front->eliminated > 0 && !rest.empty())
      x(first, Eigen::all) -= front->solved_columns * Columns(x(rest, Eigen::all));
  }
  return x.template cast<double>().array().rowwise() * size.array();
}

template <class Scalar>
VectorXd NestedLU<Scalar>::solve(const VectorXd& rhs) const {
  return substituted<1>(rhs);
}

template <class Scalar>
MatrixXd NestedLU<Scalar>::solve_columns(const MatrixXd& rhs) const {
  return substituted<Eigen::Dynamic>(rhs);
}

template <class Scalar>
void NestedLU<Scalar>::drop_factors() {
  for (Front& front : fronts_) {
    front.lu = {};
    front.waits = false;
    for (Matrix* matrix : {&front.solved_columns, &front.rows, &front.schur}) matrix->resize(0, 0);
  }
}

template <class Scalar>
double NestedLU<Scalar>::entries() const {
  double sum = 0;
  for (const Front& front : fronts_)
    sum += double(front.eliminated) * (2 * double(front.unknowns.size()) - front.eliminated);
  return sum;
}

template class NestedLU<float>;
template class NestedLU<double>;

}  // namespace rheocyte

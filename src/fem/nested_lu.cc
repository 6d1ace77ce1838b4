#include "fem/nested_lu.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <memory>
#include <utility>

#include "fem/nested_order.h"

namespace rheocyte {

using Eigen::Index;
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
      front.column_of_part[side].assign(front.unknowns.size(), -1);
      for (int i = part.eliminated; i < int(part.unknowns.size()); ++i) {
        const int at = place[part.unknowns[i]];
        const bool ends = at < front.eliminated;
        front.column_of_part[side][at] = i - part.eliminated;
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

/// The matrix is given column by column: column(j, first, rest) writes the entries in the rows that are eliminated and
/// in the other ones.
template <class Scalar>
template <class Column>
void NestedLU<Scalar>::factorise(Front& front, const Column& column) {
  const Index f = front.eliminated, o = front.remaining();
  front.factors.resize(f, f);
  front.rows.resize(o, f);
  front.solved_columns.resize(f, o);
  front.schur.resize(o, o);
  for (Index j = 0; j < f; ++j) column(j, front.factors.col(j).data(), front.rows.col(j).data());
  if (f == 0) return;
  Eigen::Ref<Matrix> in_place = front.factors;
  front.permuted_row = Eigen::PartialPivLU<Eigen::Ref<Matrix>>(in_place).permutationP().indices();
  if (o > 0) front.triangular.emplace(front.factors);
}

// So that several threads find work in a front of usual size, and that products of so few columns cost no more than of
// all. Eigen's kernels take some columns at once: of a multiple of these, the results are those of all at once.
template <class Scalar>
Index NestedLU<Scalar>::columns_at_once(Index remaining) {
  constexpr Index fewest = 128, most = 256, wanted_blocks = 4, of_kernels = 16;
  const auto over = [](Index all, Index size) { return (all + size - 1) / size; };
  const Index blocks = std::max(over(remaining, most), std::min(wanted_blocks, over(remaining, fewest)));
  return blocks == 0 ? most : over(over(remaining, blocks), of_kernels) * of_kernels;
}

template <class Scalar>
Index NestedLU<Scalar>::blocks_of(const Front& front) {
  const Index at_once = columns_at_once(front.remaining());
  return (front.remaining() + at_once - 1) / at_once;
}

template <class Scalar>
template <class Column>
void NestedLU<Scalar>::condense_block(Front& front, const Column& column, Index block) {
  const Index f = front.eliminated, at_once = columns_at_once(front.remaining()), from = block * at_once,
              size = std::min(at_once, front.remaining() - from);
  Eigen::VectorX<Scalar> first(f);
  for (Index j = from; j < from + size; ++j) {
    column(f + j, first.data(), front.schur.col(j).data());
    if (f > 0) front.solved_columns.col(j)(front.permuted_row) = first;
  }
  if (f == 0) return;
  auto solved = front.solved_columns.middleCols(from, size);
  front.triangular->solve_in_place(solved);
  front.schur.middleCols(from, size).noalias() -= front.rows * solved;
}

template <class Scalar>
void NestedLU<Scalar>::condense(int element, const Matrix& matrix, Tasks& tasks, const std::atomic<bool>* stop) {
  const Work work{tasks, stop};
  Front& front = fronts_[element];
  const auto column = [&](Index j, Scalar* first, Scalar* rest) {
    const Scalar* of_matrix = matrix.col(j).data();
    std::copy_n(of_matrix, front.eliminated, first);
    std::copy_n(of_matrix + front.eliminated, front.remaining(), rest);
  };
  if (work.is_stopped()) return;
  factorise(front, column);
  for (Index block = 0; block < blocks_of(front); ++block) {
    if (work.is_stopped()) return;
    condense_block(front, column, block);
  }
  end(element, work);
}

template <class Scalar>
bool NestedLU<Scalar>::condense(int element, const Matrix& matrix, const std::atomic<bool>* stop) {
  Tasks tasks;
  condense(element, matrix, tasks, stop);
  tasks.run(1);
  return !(stop && *stop);
}

/// A subdomain from its parts.
template <class Scalar>
void NestedLU<Scalar>::join(int front, const Work& work) {
  if (work.is_stopped()) return;
  Front& whole = fronts_[front];
  const auto column = [this, &whole](Index j, Scalar* first, Scalar* rest) { add_column(whole, j, first, rest); };
  factorise(whole, column);
  const Index blocks = blocks_of(whole);
  if (blocks == 0) return end(front, work);
  const auto left = std::make_shared<std::atomic<Index>>(blocks);
  for (Index block = 0; block < blocks; ++block) {
    work.tasks.add(rank_of_blocks, [=, this, &whole](int) {
      if (!work.is_stopped()) condense_block(whole, column, block);
      if (--*left == 0) end(front, work);
    });
  }
}

/// Column j of the matrix of a subdomain, from those of its parts.
template <class Scalar>
void NestedLU<Scalar>::add_column(const Front& whole, Index j, Scalar* first, Scalar* rest) const {
  std::fill_n(first, whole.eliminated, Scalar(0));
  std::fill_n(rest, whole.remaining(), Scalar(0));
  for (int side = 0; side < 2; ++side) {
    const int column = whole.column_of_part[side][j];
    if (column < 0) continue;
    const Scalar* part = fronts_[whole.parts[side]].schur.col(column).data();
    for (const auto& [runs, to] : {std::pair{&whole.ended[side], first}, std::pair{&whole.left[side], rest}}) {
      for (const Run& run : *runs)
        for (int i = 0; i < run.size; ++i) to[run.in_whole + i] += part[run.in_part + i];
    }
  }
}

/// Gives up what a condensed front does not need any more, and joins it if its sister is there.
template <class Scalar>
void NestedLU<Scalar>::end(int front, const Work& work) {
  Front& condensed = fronts_[front];
  condensed.triangular.reset();
  for (const int part : condensed.parts) {
    if (part >= 0) fronts_[part].schur.resize(0, 0);
  }
  if (condensed.whole < 0) return;
  const std::array<int, 2>& parts = fronts_[condensed.whole].parts;
  {
    const std::lock_guard lock(waiting_);
    condensed.waits = true;
    if (!fronts_[parts[0]].waits || !fronts_[parts[1]].waits) return;
    for (const int part : parts) fronts_[part].waits = false;
  }
  work.tasks.add(rank_of_joins, [=, this, whole = condensed.whole](int) { join(whole, work); });
}

// What is not finite anywhere makes all that is joined with it NaN, up to the pivots of the whole.
template <class Scalar>
bool NestedLU<Scalar>::is_regular() const {
  const Front& whole = fronts_.back();
  if (whole.eliminated == 0) return true;
  const auto pivots = whole.factors.diagonal().array().abs();
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
    Columns y(front.eliminated, x.cols());
    y(front.permuted_row, Eigen::all) = x(first, Eigen::all);
    front.factors.template triangularView<Eigen::UnitLower>().solveInPlace(y);
    front.factors.template triangularView<Eigen::Upper>().solveInPlace(y);
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
    front.waits = false;
    front.triangular.reset();
    for (Matrix* matrix : {&front.factors, &front.solved_columns, &front.rows, &front.schur}) matrix->resize(0, 0);
  }
}

template <class Scalar>
std::vector<typename NestedLU<Scalar>::Size> NestedLU<Scalar>::sizes() const {
  std::vector<Size> sizes;
  for (const Front& front : fronts_) sizes.push_back({front.parts, front.eliminated, int(front.remaining())});
  return sizes;
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

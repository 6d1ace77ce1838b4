#include "population/normal_nodes.h"

#include <Eigen/Eigenvalues>
#include <array>
#include <cmath>
#include <numbers>

namespace rheocyte {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int rule_nodes = 3;
const double outer_place = std::sqrt(3.0);
constexpr double outer_weight = 1.0 / 6;

double normal_density(double t) {
  return std::isfinite(t) ? std::exp(-t * t / 2) / std::sqrt(2 * std::numbers::pi) : 0;
}
double normal_below(double t) { return std::erfc(-t / std::numbers::sqrt2) / 2; }

/// Of a normal distribution, in its standard deviations.
struct NormalCut {
  double least, greatest;
  double fraction() const {
    return greatest < 0 ? normal_below(greatest) - normal_below(least) : normal_below(-least) - normal_below(-greatest);
  }
};

NormalCut cut_of(const ValueGate& gate, const GatedValue& value) {
  const double deviation = value.slope.norm();
  return {(gate.least - value.mean) / deviation, (gate.greatest - value.mean) / deviation};
}

/// The mean of the powers of what lies within, up to the fifth.
std::array<double, 6> moments_within(const NormalCut& cut) {
  const double fraction = cut.fraction();
  std::array<double, 6> moments{1};
  double lower = normal_density(cut.least), upper = normal_density(cut.greatest);
  for (std::size_t k = 1; k < moments.size(); ++k) {
    moments[k] = (lower - upper) / fraction + (k > 1 ? double(k - 1) * moments[k - 2] : 0);
    if (lower != 0) lower *= cut.least;  // which may be infinite
    if (upper != 0) upper *= cut.greatest;
  }
  return moments;
}

struct CutRule {
  double mean;
  Eigen::Vector3d place, weight;
};

/// The Gauss rule of what lies within: eigenvalues of the matrix of the recurrence of its orthogonal polynomials (Golub
/// and Welsch 1969), which follow from its central moments.
CutRule rule_within(const NormalCut& cut) {
  const auto raw = moments_within(cut);
  const double m = raw[1], c2 = raw[2] - m * m, c3 = raw[3] - 3 * m * raw[2] + 2 * m * m * m,
               c4 = raw[4] - 4 * m * raw[3] + 6 * m * m * raw[2] - 3 * std::pow(m, 4),
               c5 = raw[5] - 5 * m * raw[4] + 10 * m * m * raw[3] - 10 * std::pow(m, 3) * raw[2] + 4 * std::pow(m, 5);
  // The polynomials 1, x, x^2 - skew x - c2.
  const double skew = c3 / c2, norm = c4 - c3 * skew - c2 * c2;
  const double third = (c5 - 2 * skew * c4 + (skew * skew - 2 * c2) * c3 + 2 * skew * c2 * c2) / norm;
  Eigen::Matrix3d recurrence;
  recurrence << 0, std::sqrt(c2), 0, std::sqrt(c2), skew, std::sqrt(norm / c2), 0, std::sqrt(norm / c2), third;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(recurrence);
  return {m, solver.eigenvalues().array() + m, solver.eigenvectors().row(0).transpose().array().square()};
}

/// The turn that takes the first axis to a direction: smooth but for the opposite one.
MatrixXd turn_to(const VectorXd& direction) {
  const auto n = direction.size();
  const VectorXd first = VectorXd::Unit(n, 0), both = first + direction;
  return MatrixXd::Identity(n, n) - both * both.transpose() / (1 + direction(0)) + 2 * direction * first.transpose();
}

}  // namespace

NormalNodes normal_nodes(int numbers) {
  const double n = numbers;
  const int count = 1 + 2 * numbers * numbers;
  NormalNodes nodes{VectorXd(count), MatrixXd::Zero(numbers, count)};
  nodes.weight(0) = 1 + n * (n - 7) / 18;
  int next = 1;
  for (int i = 0; i < numbers; ++i)
    for (const double a : {-outer_place, outer_place}) {
      nodes.weight(next) = (4 - n) / 18;
      nodes.place(i, next++) = a;
      for (int k = 0; k < i; ++k)
        for (const double b : {-outer_place, outer_place}) {
          nodes.weight(next) = outer_weight * outer_weight;
          nodes.place(i, next) = a;
          nodes.place(k, next++) = b;
        }
    }
  return nodes;
}

double fraction_within(const ValueGate& gate, const GatedValue& value) { return cut_of(gate, value).fraction(); }

/// Smolyak's sum again, with the value as the first number: its mean with the rule above over the others, and the rest
/// of its own rule with that of the third degree.
NormalNodes kept_nodes(const ValueGate& gate, const GatedValue& value) {
  const CutRule rule = rule_within(cut_of(gate, value));
  const int others = int(value.slope.size()) - 1;
  const NormalNodes fifth = normal_nodes(others);
  const auto count_fifth = int(fifth.weight.size()), count_third = 1 + 2 * others;
  NormalNodes third{VectorXd::Constant(count_third, outer_weight), MatrixXd::Zero(others, count_third)};
  third.weight(0) = 1 - double(others) / 3;
  for (int i = 0; i < 2 * others; ++i) third.place(i / 2, 1 + i) = i % 2 == 0 ? -outer_place : outer_place;
  const int count = count_fifth + (1 + rule_nodes) * count_third;
  NormalNodes nodes{VectorXd(count), MatrixXd(others + 1, count)};
  nodes.weight.head(count_fifth) = fifth.weight;
  nodes.place.leftCols(count_fifth) << Eigen::RowVectorXd::Constant(count_fifth, rule.mean), fifth.place;
  for (int k = -1; k < rule_nodes; ++k) {
    const int first = count_fifth + (k + 1) * count_third;
    nodes.weight.segment(first, count_third) = (k < 0 ? -1 : rule.weight(k)) * third.weight;
    nodes.place.middleCols(first, count_third)
        << Eigen::RowVectorXd::Constant(count_third, k < 0 ? rule.mean : rule.place(k)),
        third.place;
  }
  nodes.place = turn_to(value.slope.normalized()) * nodes.place;
  return nodes;
}

}  // namespace rheocyte

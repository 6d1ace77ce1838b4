#include "table/elongated_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>
#include <numeric>
#include <utility>

#include "case/user_error.h"
#include "numeric/dense_solve.h"
#include "numeric/lagrange.h"
#include "numeric/local_cubic.h"
#include "shape/outline_shape.h"
#include "table/origin_record.h"

namespace rheocyte {
namespace {

constexpr std::array measures{Measure::area_um2,        Measure::deformation,     Measure::named("inertia_ratio"),
                              Measure::named("mode_2"), Measure::named("mode_3"), Measure::named("mode_4"),
                              Measure::named("mode_5"), Measure::named("mode_6"), Measure::named("mode_7")};
static_assert(measures.size() == std::size_t(elongated_measures));

/// Nodes of the interpolation in each direction: cubics between them miss far less than the polynomials.
constexpr int radius_nodes = 33, axial_nodes = 17, height_nodes = 17;

/// Odd modes of the radius, which go with the compliance of stiff cells.
bool is_odd_measure(int measure) {
  const int above = measure - number_of(ElongatedMeasure::mode_2);
  return above > 0 && order_of_mode(min_mode + above) == 1;
}

/// ln(1 / E) at the ends of the branches: a smooth surface over radius and axial ratio that no branch falls short of by
/// more than polynomials can go on. It is linear in ln(radius) for small cells.
class BranchEnds {
 public:
  explicit BranchEnds(const ElongatedContent& content) : scale_(content) {
    constexpr double max_continuation = 0.02;
    const std::size_t radii = content.radii_um.size(), axials = content.axial_ratios.size();
    Eigen::MatrixXd terms(Eigen::Index(radii * axials), count);
    Eigen::VectorXd last(terms.rows());
    Eigen::Index row = 0;
    for (std::size_t i = 0; i < radii; ++i)
      for (std::size_t j = 0; j < axials; ++j, ++row) {
        terms.row(row) = terms_of(scale_.fraction_of(content.radii_um[i]), content.axial_ratios[j]);
        last(row) = -std::log(content.modulus_kPa[content.branch(i, j) + std::size_t(content.states) - 1]);
      }
    weights_ = least_squares(terms, last);
    weights_(0) -= std::max((terms * weights_ - last).maxCoeff() - max_continuation, 0.0);
  }

  double operator()(double radius, double axial_ratio) const { return terms_of(radius, axial_ratio) * weights_; }

 private:
  static constexpr int count = 11;
  /// All products up to the third degree, and the logarithm.
  Eigen::RowVectorXd terms_of(double x, double y) const {
    Eigen::RowVectorXd terms(count);
    terms << 1, x, y, x * x, x * y, y * y, x * x * x, x * x * y, x * y * y, y * y * y, std::log(scale_.radius_um(x));
    return terms;
  }

  RadiusScale scale_;
  Eigen::VectorXd weights_;
};

/// Coordinates of the computed branches and the polynomials along them.
class ElongatedBranches {
 public:
  explicit ElongatedBranches(const ElongatedContent& content)
      : content_(content), along_(coordinates(content)), ends_(content) {}

  const std::vector<double>& along() const { return along_; }
  double log_end(double radius, double axial_ratio) const { return ends_(radius, axial_ratio); }

  /// Heights of the states of a branch.
  std::vector<double> heights(std::size_t i, std::size_t j) const {
    const double end = std::exp(ends_(along_[i], content_.axial_ratios[j]));
    std::vector<double> heights;
    for (int k = 0; k < content_.states; ++k)
      heights.push_back(1 / (content_.modulus_kPa[content_.branch(i, j) + std::size_t(k)] * end));
    return heights;
  }
  /// Of a state, odd modes over its height.
  double value(std::size_t i, std::size_t j, std::size_t k, int measure) const {
    const double height = is_odd_measure(measure) ? heights(i, j)[k] : 1;
    return content_.value[std::size_t(measure)][content_.branch(i, j) + k] / height;
  }
  /// The same of all measures at any height.
  Eigen::Array<double, elongated_measures, 1> values_at(std::size_t i, std::size_t j, double height) const {
    const auto nodes = heights(i, j);
    const auto weights = lagrange_weights(nodes, height).value;
    Eigen::Array<double, elongated_measures, 1> sums = Eigen::Array<double, elongated_measures, 1>::Zero();
    for (int m = 0; m < elongated_measures; ++m)
      for (std::size_t k = 0; k < nodes.size(); ++k)
        sums(m) +=
            weights[k] * content_.value[std::size_t(m)][content_.branch(i, j) + k] / (is_odd_measure(m) ? nodes[k] : 1);
    return sums;
  }

 private:
  static std::vector<double> coordinates(const ElongatedContent& content) {
    const RadiusScale scale(content);
    std::vector<double> along;
    for (const double radius : content.radii_um) along.push_back(scale.fraction_of(radius));
    return along;
  }

  const ElongatedContent& content_;
  std::vector<double> along_;
  BranchEnds ends_;
};

/// By how much, relative, the polynomial through all other nodes misses a value that has no zero.
double miss(std::vector<double> nodes, std::vector<double> values, std::size_t left_out) {
  const auto at = std::ptrdiff_t(left_out);
  const double place = nodes[left_out], value = values[left_out];
  nodes.erase(nodes.begin() + at);
  values.erase(values.begin() + at);
  const auto weights = lagrange_weights(nodes, place).value;
  return std::abs(std::inner_product(weights.begin(), weights.end(), values.begin(), 0.0) / value - 1);
}

/// Of the asymmetry, with which the compliance goes: the greatest miss by leaving out one radius, axial ratio or state.
double greatest_miss(const ElongatedContent& content) {
  constexpr int mode_3 = number_of(ElongatedMeasure::mode_3);
  const ElongatedBranches branches(content);
  const std::size_t radii = content.radii_um.size(), axials = content.axial_ratios.size(),
                    states = std::size_t(content.states);
  double greatest = 0;
  for (std::size_t k = 1; k + 1 < states; ++k) {
    const double height = double(k) / double(states - 1);
    for (std::size_t j = 0; j < axials; ++j) {
      std::vector<double> across;
      for (std::size_t i = 0; i < radii; ++i) across.push_back(branches.values_at(i, j, height)(mode_3));
      for (std::size_t i = 1; i + 1 < radii; ++i) greatest = std::max(greatest, miss(branches.along(), across, i));
    }
    for (std::size_t i = 0; i < radii; ++i) {
      std::vector<double> across;
      for (std::size_t j = 0; j < axials; ++j) across.push_back(branches.values_at(i, j, height)(mode_3));
      for (std::size_t j = 1; j + 1 < axials; ++j) greatest = std::max(greatest, miss(content.axial_ratios, across, j));
      for (std::size_t j = 0; j < axials; ++j) {
        std::vector<double> up;
        for (std::size_t other = 0; other < states; ++other) up.push_back(branches.value(i, j, other, mode_3));
        greatest = std::max(greatest, miss(branches.heights(i, j), up, k));
      }
    }
  }
  return greatest;
}

}  // namespace

ElongatedContent elongated_content(const TableSpec& spec, std::span<const SampledBranch> all,
                                   std::string_view version) {
  /// Polynomials that have a node miss less between the nodes than those that leave it out there.
  constexpr double fraction_of_miss = 0.1;
  ElongatedContent content;
  content.origin = origin_of(spec, version);
  content.radii_um = computed_radii_um(spec);
  content.axial_ratios = spec.axial_ratios;
  content.elongation = spec.elongation;
  content.states = spec.computed_states.value();
  for (const double radius : content.radii_um)
    for (const double axial : content.axial_ratios) {
      const auto branch = std::ranges::find_if(all, [&](const SampledBranch& b) {
        return std::abs(b.radius_um - radius) < 1e-9 * radius && b.axial_ratio == axial;
      });
      if (branch == all.end() || branch->samples() != content.states)
        throw UserError(
            fmt::format("the branch of radius {:.4g} um and axial ratio {:g} has no states ({}); a table of elongated "
                        "cells needs all. Choose smaller cells or other numbers for table.axial_ratio.",
                        radius, axial, branch == all.end() ? "not computed" : branch->end.message));
      for (int k = 0; k < content.states; ++k) {
        content.modulus_kPa.push_back(branch->stiffness[std::size_t(k)]);
        for (int m = 0; m < elongated_measures; ++m)
          content.value[std::size_t(m)].push_back(
              m == 0 ? std::log(branch->at(k, measures[0]) / (std::numbers::pi * radius * radius))
                     : branch->at(k, measures[std::size_t(m)]));
      }
    }
  content.error = fraction_of_miss * greatest_miss(content);
  return content;
}

RadiusScale::RadiusScale(const ElongatedContent& content)
    : half_width_um(content.origin.flow.width_um / 2),
      first(radius_coordinate(content.radii_um.front() / half_width_um)),
      last(radius_coordinate(content.radii_um.back() / half_width_um)) {}

double RadiusScale::fraction_of(double radius_um) const {
  return (radius_coordinate(radius_um / half_width_um) - first) / (last - first);
}

double RadiusScale::radius_um(double fraction) const {
  return half_width_um * radius_ratio_at(first + fraction * (last - first));
}

double RadiusScale::log_radius_slope(double fraction) const {
  const double ratio = radius_ratio_at(first + fraction * (last - first));
  return (last - first) * (radius_ratio_at(INFINITY) - ratio) / ratio;
}

ElongatedTable::ElongatedTable(ElongatedContent content) : content_(std::move(content)), scale_(content_) {
  const ElongatedBranches branches(content_);
  const std::size_t radii = content_.radii_um.size(), axials = content_.axial_ratios.size();
  // One direction after the other: along the branches, over the axial ratio, over the radius.
  std::vector<std::vector<Node>> along(radii * axials), over_axial(radii);
  for (std::size_t i = 0; i < radii; ++i)
    for (std::size_t j = 0; j < axials; ++j)
      for (int k = 0; k < height_nodes; ++k) {
        Node& node = along[i * axials + j].emplace_back(Node::Zero());
        node.head<elongated_measures>() = branches.values_at(i, j, double(k) / (height_nodes - 1));
      }
  const auto [least, greatest] = std::pair(content_.axial_ratios.front(), content_.axial_ratios.back());
  for (std::size_t i = 0; i < radii; ++i)
    for (int j = 0; j < axial_nodes; ++j) {
      const auto weights =
          lagrange_weights(content_.axial_ratios, std::lerp(least, greatest, double(j) / (axial_nodes - 1))).value;
      for (std::size_t k = 0; k < std::size_t(height_nodes); ++k) {
        Node& node = over_axial[i].emplace_back(Node::Zero());
        for (std::size_t other = 0; other < axials; ++other) node += weights[other] * along[i * axials + other][k];
      }
    }
  for (int i = 0; i < radius_nodes; ++i) {
    const double place = double(i) / (radius_nodes - 1);
    const auto weights = lagrange_weights(branches.along(), place).value;
    for (std::size_t at = 0; at < std::size_t(axial_nodes * height_nodes); ++at) {
      const std::size_t sheet = at / std::size_t(height_nodes);
      Node& node = nodes_.emplace_back(Node::Zero());
      for (std::size_t other = 0; other < radii; ++other) node += weights[other] * over_axial[other][at];
      const double axial = std::lerp(least, greatest, double(sheet) / (axial_nodes - 1));
      node(elongated_measures) = -branches.log_end(place, axial);
    }
  }
}

ElongatedCell ElongatedTable::without_elongation(const ElongatedCell& cell) const {
  const double height = at({cell(0), 0, 1}).log_modulus - at(cell).log_modulus;
  return {cell(0), 0, std::min(std::exp(height), 1.0)};
}

ElongatedState ElongatedTable::at(const ElongatedCell& cell) const {
  const double height = cell(2);
  assert(height > 0);
  const double first_axial = content_.axial_ratios.front(),
               axial_step = (content_.axial_ratios.back() - first_axial) / (axial_nodes - 1);
  const LocalCubic x = local_cubic(cell(0) * (radius_nodes - 1), radius_nodes),
                   y = local_cubic((cell(1) - first_axial) / axial_step, axial_nodes),
                   z = local_cubic(height * (height_nodes - 1), height_nodes);
  Node value = Node::Zero(), by_x = Node::Zero(), by_y = Node::Zero(), by_z = Node::Zero();
  for (std::size_t i = 0; i < 4; ++i) {
    Node sum = Node::Zero(), sum_by_y = Node::Zero(), sum_by_z = Node::Zero();
    for (std::size_t j = 0; j < 4; ++j) {
      const Node* line =
          &nodes_[std::size_t(((x.first + int(i)) * axial_nodes + y.first + int(j)) * height_nodes + z.first)];
      const Node here = z.value[0] * line[0] + z.value[1] * line[1] + z.value[2] * line[2] + z.value[3] * line[3];
      sum += y.value[j] * here;
      sum_by_y += y.slope[j] * here;
      sum_by_z +=
          y.value[j] * (z.slope[0] * line[0] + z.slope[1] * line[1] + z.slope[2] * line[2] + z.slope[3] * line[3]);
    }
    value += x.value[i] * sum;
    by_x += x.slope[i] * sum;
    by_y += x.value[i] * sum_by_y;
    by_z += x.value[i] * sum_by_z;
  }
  by_x *= radius_nodes - 1;
  by_y /= axial_step;
  by_z *= height_nodes - 1;
  for (int m = 0; m < elongated_measures; ++m)
    if (is_odd_measure(m)) {
      by_z(m) = value(m) + height * by_z(m);
      for (Node* node : {&value, &by_x, &by_y}) (*node)(m) *= height;
    }
  ElongatedState state;
  state.value = value.head<elongated_measures>();
  state.slope << by_x.head<elongated_measures>(), by_y.head<elongated_measures>(), by_z.head<elongated_measures>();
  state.radius_um = scale_.radius_um(cell(0));
  state.log_radius_slope = scale_.log_radius_slope(cell(0));
  state.log_modulus = value(elongated_measures) - std::log(height);
  state.log_modulus_slope << by_x(elongated_measures), by_y(elongated_measures), -1 / height;
  return state;
}

double ElongatedState::log_area() const {
  return value(number_of(ElongatedMeasure::log_area_ratio)) + std::log(std::numbers::pi * radius_um * radius_um);
}

Eigen::Vector3d ElongatedState::log_area_slope() const {
  Eigen::Vector3d slopes = slope.row(number_of(ElongatedMeasure::log_area_ratio)).matrix().transpose();
  slopes(0) += 2 * log_radius_slope;
  return slopes;
}

}  // namespace rheocyte

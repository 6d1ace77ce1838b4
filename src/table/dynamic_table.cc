#include "table/dynamic_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>

#include "numeric/lagrange.h"

namespace rheocyte {

namespace {

/// A measure of the undeformed cell, and the power of 1/E with which it departs from it where it is small: divided by
/// that power it changes little from modulus to modulus.
struct Law {
  double rest, power;
};

Law law_of(CourseMeasure measure) {
  switch (measure) {
    case CourseMeasure::deformation: return {0, 2};
    case CourseMeasure::area_ratio: return {1, 2};
    case CourseMeasure::inertia_ratio: return {1, 1};
    case CourseMeasure::velocity:
    case CourseMeasure::time: return {0, 0};
    default: return {0, 1};
  }
}

/// Cubic through the four places round it.
struct PlaceWeights {
  int first;
  std::vector<double> weight;
};

PlaceWeights place_weights(std::span<const double> places, double place) {
  const int count = int(places.size());
  const int above = int(std::ranges::upper_bound(places, place) - places.begin());
  const int first = std::clamp(above - 2, 0, count - 4);
  return {first, lagrange_weights(places.subspan(std::size_t(first), 4), place).value};
}

/// Rows of weights, one for each coordinate; those outside count as the border.
Eigen::MatrixXd weight_rows(const std::vector<double>& nodes, std::span<const double> at) {
  Eigen::MatrixXd rows(Eigen::Index(at.size()), Eigen::Index(nodes.size()));
  for (std::size_t i = 0; i < at.size(); ++i) {
    const auto weights = lagrange_weights(nodes, std::clamp(at[i], nodes.front(), nodes.back())).value;
    rows.row(Eigen::Index(i)) = Eigen::Map<const Eigen::RowVectorXd>(weights.data(), Eigen::Index(weights.size()));
  }
  return rows;
}

double relative_difference(const Eigen::VectorXd& one, const Eigen::VectorXd& other) {
  return (one - other).cwiseAbs().maxCoeff() / one.cwiseAbs().maxCoeff();
}

}  // namespace

DynamicTable::DynamicTable(DynamicContent content)
    : content_(std::move(content)), axes_(nodes_of(content_.spec)), places_(places_of(content_.spec)) {
  assert(int(content_.courses.size()) == nodes(spec()) + spec().checks);
  assert(std::ranges::all_of(content_.courses, [](const auto& c) { return c.status == Status::converged; }));
  errors_ = compare();
}

bool DynamicTable::has_radius(double radius_um) const {
  return radius_um >= axes_[0].front() && radius_um <= axes_[0].back();
}

bool DynamicTable::has_place(double place_um) const {
  return place_um >= places_.front() && place_um <= places_.back();
}

Eigen::MatrixXd DynamicTable::values(CourseMeasure measure, double radius_um, double place_um,
                                     std::span<const double> log_modulus, std::span<const double> log_time) const {
  const auto& [radii, moduli, times] = axes_;
  const Law law = law_of(measure);
  const PlaceWeights place = place_weights(places_, place_um);
  const auto of_radius = lagrange_weights(radii, std::clamp(radius_um, radii.front(), radii.back())).value;
  const auto of_place = Eigen::Map<const Eigen::Vector4d>(place.weight.data());
  Eigen::MatrixXd at_nodes = Eigen::MatrixXd::Zero(Eigen::Index(moduli.size()), Eigen::Index(times.size()));
  for (std::size_t i = 0, node = 0; i < radii.size(); ++i)
    for (std::size_t j = 0; j < moduli.size(); ++j) {
      const double stiffness = std::exp(law.power * (moduli[j] - moduli.back()));
      for (std::size_t k = 0; k < times.size(); ++k, ++node) {
        const auto way = content_.courses[node].value.col(int(measure)).segment<4>(place.first);
        at_nodes(Eigen::Index(j), Eigen::Index(k)) += of_radius[i] * stiffness * (of_place.dot(way) - law.rest);
      }
    }
  Eigen::MatrixXd result = weight_rows(moduli, log_modulus) * at_nodes * weight_rows(times, log_time).transpose();
  for (std::size_t i = 0; i < log_modulus.size(); ++i) {
    const double above = std::clamp(log_modulus[i], moduli.front(), moduli.back()) - moduli.back();
    result.row(Eigen::Index(i)) *= std::exp(-law.power * above);
  }
  return result.array() + law.rest;
}

double DynamicTable::value(CourseMeasure measure, const DynamicCell& cell, double place_um) const {
  const auto [radius, modulus, time] = coordinates_of(spec(), cell);
  return values(measure, radius, place_um, {&modulus, 1}, {&time, 1})(0, 0);
}

CourseErrors DynamicTable::compare() const {
  CourseErrors errors{spec().checks};
  for (int i = nodes(spec()); i < int(content_.courses.size()); ++i) {
    const CellCourse& course = content_.courses[std::size_t(i)];
    const auto differs = [&](CourseMeasure measure) {
      Eigen::VectorXd between(Eigen::Index(places_.size()));
      for (std::size_t k = 0; k < places_.size(); ++k)
        between(Eigen::Index(k)) = value(measure, course.cell, places_[k]);
      return relative_difference(course.value.col(int(measure)), between);
    };
    errors.mode_3 = std::max(errors.mode_3, differs(CourseMeasure::mode_3));
    errors.deformation = std::max(errors.deformation, differs(CourseMeasure::deformation));
  }
  return errors;
}

}  // namespace rheocyte

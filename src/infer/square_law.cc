#include "infer/square_law.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "infer/square_changes.h"

namespace rheocyte {

namespace {

/// Of the numbers of a cell, in the order of its members: those of the cells to which the law was fitted.
struct Range {
  double least, greatest;
};
constexpr std::array<Range, 6> ranges{{{0.40, 0.82}, {-0.06, 0.42}, {0, 0.12}, {0, 1}, {0, 0.85}, {0, 0.5}}};

using Places = std::array<double, ranges.size()>;

constexpr int features = int(square_changes.size());  // the first ones
constexpr std::size_t term_count = square_changes[0].size();

/// The coefficients of one term of all features, in whole packets of the processor.
using OfFeatures = Eigen::Array<double, (features + 3) / 4 * 4, 1>;
constexpr auto changes_by_term = [] {
  std::array<std::array<double, OfFeatures::SizeAtCompileTime>, term_count> by_term{};
  for (std::size_t i = 0; i < std::size_t(features); ++i)
    for (std::size_t term = 0; term < term_count; ++term) by_term[term][i] = square_changes[i][term];
  return by_term;
}();

/// Each from -1 to 1 in its range.
Places places_of(const CellInSquare& cell) {
  Places places{cell.radius, cell.mode_2, cell.mode_3, cell.cortex_fraction, cell.cortex_tension, cell.thinning};
  for (std::size_t i = 0; i < places.size(); ++i) {
    const auto [least, greatest] = ranges[i];
    places[i] = 2 * (std::clamp(places[i], least, greatest) - least) / (greatest - least) - 1;
  }
  return places;
}

/// Long soft cells are about to be dented behind, where the modes of their hull have kinks: so much of a change is
/// left.
constexpr double left_of_odd_modes = 0.3;

bool is_odd_mode(int feature) {
  const int k = feature - int(ShapeFeature::first_mode) + min_mode;
  return k > min_mode && order_of_mode(k) == 1;
}

/// Products of up to three of them.
std::array<double, term_count> terms_of(const Places& places) {
  std::array<double, term_count> terms;
  auto next = terms.begin();
  *next++ = 1;
  next = std::ranges::copy(places, next).out;
  for (std::size_t i = 0; i < places.size(); ++i)
    for (std::size_t j = i; j < places.size(); ++j) *next++ = places[i] * places[j];
  for (std::size_t i = 0; i < places.size(); ++i)
    for (std::size_t j = i; j < places.size(); ++j)
      for (std::size_t k = j; k < places.size(); ++k) *next++ = places[i] * places[j] * places[k];
  return terms;
}

}  // namespace

ShapeVector mean_change_by_square(const CellInSquare& cell) {
  const auto terms = terms_of(places_of(cell));
  const double mode_3 = std::clamp(cell.mode_3, ranges[2].least, ranges[2].greatest);
  OfFeatures sum = OfFeatures::Zero();
  for (std::size_t term = 0; term < term_count; ++term)
    sum += terms[term] * Eigen::Map<const OfFeatures>(changes_by_term[term].data());
  ShapeVector change = ShapeVector::Zero();
  change.head<features>() = mode_3 * sum.head<features>();
  return change;
}

ShapeErrors change_by_square(const CellInSquare& cell) {
  const double mode_3 = std::clamp(cell.mode_3, ranges[2].least, ranges[2].greatest);
  ShapeErrors change;
  change.bias = mean_change_by_square(cell);
  Eigen::Array<double, features, 1> left;
  for (int i = 0; i < features; ++i) {
    const double of_change = is_odd_mode(i) ? left_of_odd_modes * change.bias(i) : 0;
    left(i) = std::hypot(mode_3 * square_left[std::size_t(i)], of_change, mode_3 > 0 ? error_between_branches : 0);
  }
  for (int i = 0; i < features; ++i)
    for (int k = 0; k < features; ++k)
      change.covariance(i, k) = left(i) * left(k) * square_correlations[std::size_t(i)][std::size_t(k)];
  return change;
}

}  // namespace rheocyte

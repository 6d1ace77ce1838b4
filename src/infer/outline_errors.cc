#include "infer/outline_errors.h"

#include <cassert>
#include <cmath>
#include <numbers>

#include "infer/rendered_errors.h"
#include "measurement/shape_in_pixels.h"
#include "numeric/dense_solve.h"

namespace rheocyte {
namespace {

constexpr int rendered_cells = 2000, places_of_rendered = 8;

Eigen::MatrixXd fitted(const Eigen::MatrixXd& rows, const Eigen::MatrixXd& found) {
  return solve_dense(rows.transpose() * rows, rows.transpose() * found);
}

double radius_of(double log_area) { return std::exp(log_area / 2) * std::numbers::inv_sqrtpi; }

}  // namespace

OutlineErrors::OutlineErrors(const ElongatedTable& table, double width_um, double pixel_size_um,
                             const OutlineNoise& noise)
    : noise_(noise) {
  if (noise.deviation == 0) return;
  assert(noise.correlation > 0);
  constexpr int first = int(ShapeFeature::first_mode), known = elongated_measures - number_of(ElongatedMeasure::mode_2);
  Eigen::MatrixXd rows(rendered_cells, term_count), bias(rendered_cells, feature_count),
      covariance(rendered_cells, covariances);
  for (int i = 0; i < rendered_cells; ++i) {
    CellRandom anywhere(1, std::uint64_t(i), Purpose::population);
    ElongatedCell cell;
    for (Eigen::Index k = 0; k < cell.size(); ++k)
      cell(k) = std::lerp(table.least()(k), table.greatest()(k), anywhere.uniform());
    const ElongatedState state = table.at(cell);
    const double log_area = state.log_area() + 2 * std::log(width_um / table.origin().flow.width_um);
    ShapeVector smooth = ShapeVector::Zero();
    smooth(int(ShapeFeature::area_um2)) = log_area;
    smooth.segment<known>(first) = state.value.tail<known>();
    const Eigen::MatrixX2d outline = outline_of(smooth);
    CellRandom random(1, std::uint64_t(i), Purpose::contour), again = random;
    const ShapeErrors with = errors_in_pixels(outline, pixel_size_um, 2 * places_of_rendered, random, noise),
                      without = errors_in_pixels(outline, pixel_size_um, places_of_rendered, again);
    rows.row(i) = terms_at(log_area, smooth(first), smooth(first + 1));
    const Scales scales = scales_at(log_area);
    bias.row(i) = (with.bias - without.bias).transpose() / scales.bias;
    covariance.row(i) = (with.covariance - without.covariance).reshaped().transpose() / scales.covariance;
  }
  bias_ = fitted(rows, bias);
  covariance_ = fitted(rows.leftCols<terms_of_second_degree>(), covariance);
}

OutlineErrors::Scales OutlineErrors::scales_at(double log_area) const {
  const double r = radius_of(log_area), square = std::pow(noise_.deviation / r, 2);
  return {square, square * noise_.correlation / r};
}

OutlineErrors::Terms OutlineErrors::terms_at(double log_area, double mode_2, double mode_3) const {
  constexpr double unit = 0.1;  // so that powers are alike, and the normal equations well conditioned
  const double s = noise_.correlation / radius_of(log_area);
  Terms terms;
  Eigen::Index next = 0;
  for (int all = 0; all <= degree; ++all)
    for (int i = 0; i <= all; ++i)
      for (int j = 0; i + j <= all; ++j)
        terms(next++) = std::pow(s / unit, i) * std::pow(mode_2 / unit, j) * std::pow(mode_3 / unit, all - i - j);
  return terms;
}

ShapeErrors OutlineErrors::at(double log_area, double mode_2, double mode_3) const {
  if (noise_.deviation == 0) return {};
  const Terms terms = terms_at(log_area, mode_2, mode_3);
  const Scales scales = scales_at(log_area);
  ShapeErrors errors;
  errors.bias = scales.bias * (terms * bias_).transpose();
  errors.covariance =
      scales.covariance * (terms.head<terms_of_second_degree>() * covariance_).reshaped(feature_count, feature_count);
  return errors;
}

}  // namespace rheocyte

#include "infer/outline_errors.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "infer/rendered_errors.h"
#include "measurement/shape_in_pixels.h"
#include "numeric/dense_solve.h"

namespace rheocyte {
namespace {

constexpr int rendered_cells = 500, places_of_rendered = 8;

double radius_of(double log_area) { return std::exp(log_area / 2) * std::numbers::inv_sqrtpi; }

}  // namespace

OutlineErrors::OutlineErrors(const ElongatedTable& table, double length, double pixel_size_um,
                             const OutlineNoise& noise)
    : noise_(noise) {
  if (noise.deviation == 0) return;
  constexpr int first = int(ShapeFeature::first_mode), known = elongated_measures - number_of(ElongatedMeasure::mode_2);
  Eigen::MatrixXd rows(rendered_cells, terms), found(rendered_cells, numbers);
  for (int i = 0; i < rendered_cells; ++i) {
    CellRandom anywhere(1, std::uint64_t(i), Purpose::population);
    ElongatedCell cell;
    for (Eigen::Index k = 0; k < cell.size(); ++k)
      cell(k) = std::lerp(table.least()(k), table.greatest()(k), anywhere.uniform());
    const ElongatedState state = table.at(cell);
    const double log_area = state.log_area() + 2 * std::log(length);
    ShapeVector smooth = ShapeVector::Zero();
    smooth(int(ShapeFeature::area_um2)) = log_area;
    smooth.segment<known>(first) = state.value.tail<known>();
    const Eigen::MatrixX2d outline = outline_of(smooth);
    CellRandom random(1, std::uint64_t(i), Purpose::contour), again = random;
    const ShapeErrors with = errors_in_pixels(outline, pixel_size_um, 2 * places_of_rendered, random, noise),
                      without = errors_in_pixels(outline, pixel_size_um, places_of_rendered, again);
    rows.row(i) = terms_at(log_area, smooth(first), smooth(first + 1));
    found.row(i) << (with.bias - without.bias).transpose(),
        (with.covariance - without.covariance).reshaped().transpose();
    found.row(i) *= std::pow(radius_of(log_area) / noise.deviation, 2);
  }
  law_ = solve_dense(rows.transpose() * rows, rows.transpose() * found);
}

OutlineErrors::Terms OutlineErrors::terms_at(double log_area, double mode_2, double mode_3) const {
  const double s = noise_.correlation / radius_of(log_area);
  Terms terms;
  terms << 1, s, mode_2, mode_3, s * s, s * mode_2, s * mode_3, mode_2 * mode_2, mode_2 * mode_3, mode_3 * mode_3;
  return terms;
}

ShapeErrors OutlineErrors::at(double log_area, double mode_2, double mode_3) const {
  if (noise_.deviation == 0) return {};
  const Eigen::Matrix<double, 1, numbers> all =
      std::pow(noise_.deviation / radius_of(log_area), 2) * (terms_at(log_area, mode_2, mode_3) * law_);
  ShapeErrors errors;
  errors.bias = all.head<feature_count>().transpose();
  errors.covariance = all.tail<feature_count * feature_count>().reshaped(feature_count, feature_count);
  return errors;
}

}  // namespace rheocyte

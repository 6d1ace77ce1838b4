// Virtual cells of a law, and pictures of them.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "infer/combined_moments.h"
#include "measurement/shape_in_pixels.h"
#include "numeric/cell_random.h"
#include "numeric/dense_solve.h"

namespace rheocyte {

namespace {

using Eigen::MatrixXd;

constexpr int pictures_of_cell = 8;
/// Where gates keep less, nothing is drawn.
constexpr std::size_t most_tries_of_kept = 50, most_tries = 2;

/// Far beyond the table shapes that go straight on are none.
bool is_plausible(const ShapeVector& shape, double channel_width_um) {
  constexpr double most_mode = 0.6;
  const double radius_um = std::exp(shape(int(ShapeFeature::area_um2)) / 2) * std::numbers::inv_sqrtpi;
  return shape.allFinite() && shape.tail<mode_count>().cwiseAbs().sum() < most_mode && radius_um < channel_width_um;
}

}  // namespace

bool CombinedMoments::render(const CombinedVector& parameters, std::size_t pictures) {
  const CombinedLaw law = CombinedLaw::of(parameters);
  const std::size_t cells = pictures / pictures_of_cell, tries = cells * (gate_ ? most_tries_of_kept : most_tries);
  const double added_to_area = pixels_.middle.bias(int(ShapeFeature::area_um2));
  const Progress of_mean = progress(law);
  MatrixXd terms(cells, varying + 1), bias(cells, feature_count);
  pixels_.middle = {};
  std::size_t i = 0;
  for (std::uint64_t number = 0; i < cells && number < tries; ++number) {
    const Numbers place = drawn_place(1, number);
    const ShapeVector smooth = shape(law, place, of_mean).value;
    if (!is_plausible(smooth, sight_.flow.width_um)) continue;
    if (!passes(smooth(int(ShapeFeature::area_um2)) + added_to_area)) continue;
    CellRandom random(1, number, Purpose::picture);
    const ShapeErrors errors =
        errors_in_pixels(outline_of(smooth), pixel_size_um_, pictures_of_cell, random, outline_noise_);
    terms.row(Eigen::Index(i)) << 1, place.transpose();
    bias.row(Eigen::Index(i)) = errors.bias.transpose();
    pixels_.middle.covariance += errors.covariance;
    ++i;
  }
  if (i < cells) return false;
  pixels_.middle.covariance /= double(cells);
  const MatrixXd found = solve_dense(terms.transpose() * terms, terms.transpose() * bias);
  pixels_.middle.bias = found.row(0).transpose();
  pixels_.slope = found.bottomRows(varying).transpose();
  return true;
}

std::vector<ShapeVector> CombinedMoments::drawn(const CombinedVector& parameters, std::size_t events) const {
  const MatrixXd white = whitening(pixels_.middle.covariance);
  if (white.size() == 0) return {};
  const MatrixXd root = dense_inverse(white);
  const CombinedLaw law = CombinedLaw::of(parameters);
  const Progress of_mean = progress(law);
  std::vector<ShapeVector> all;
  for (std::uint64_t i = 0; all.size() < events && i < events * (gate_ ? most_tries_of_kept : 1); ++i) {
    CellRandom random(0, i, Purpose::picture);
    ShapeVector noise;
    for (double& number : noise) number = random.normal();
    const Numbers place = drawn_place(0, i);
    const ShapeVector cell =
        shape(law, place, of_mean).value + pixels_.middle.bias + pixels_.slope * place + root * noise;
    if (passes(cell(int(ShapeFeature::area_um2)))) all.push_back(cell);
  }
  return all;
}

std::vector<ShapeVector> CombinedMoments::drawn_smooth(const CombinedVector& parameters, std::size_t events,
                                                       std::uint64_t seed) const {
  const CombinedLaw law = CombinedLaw::of(parameters);
  const Progress of_mean = progress(law);
  std::vector<ShapeVector> all;
  for (std::size_t i = 0; i < events; ++i) all.push_back(shape(law, drawn_place(seed, i), of_mean).value);
  return all;
}

/// Sizes, fractions and tensions of the cortex beyond the table's are the nearest ones of it.
CombinedMoments::Side CombinedMoments::side(const Numbers& numbers, double first) const {
  const CellBox& box = moduli_.table().box();
  CellCoordinates cell = place_in_table(numbers, shape_in_tube(numbers, first).progress);
  for (const int x : {x_radius, x_fraction, x_ratio}) cell(x) = std::clamp(cell(x), box.least(x), box.greatest(x));
  if (cell(x_axial) > box.greatest(x_axial)) return Side::longer;
  return cell(x_progress) <= box.least(x_progress) || moduli_.table().is_inside(cell) ? Side::within : Side::softer;
}

CellsBeyond CombinedMoments::beyond(const CombinedVector& parameters, std::size_t cells) const {
  const CombinedLaw law = CombinedLaw::of(parameters);
  const Progress of_mean = progress(law);
  std::vector<Numbers> beyond;
  CellsBeyond found{.all = cells};
  for (std::size_t i = 0; i < cells; ++i) {
    const Numbers cell = numbers(law, drawn_place(0, i));
    const Side of_cell = side(cell, of_mean.at(cell));
    if (of_cell != Side::within) beyond.push_back(cell);
    ++(of_cell == Side::softer ? found.softer : of_cell == Side::longer ? found.longer : found.within);
  }
  if (2 * beyond.size() > cells)
    for (const Numbers& cell : beyond) found.log_stiffness_of_last.push_back(softest(cell, of_mean.at(cell)));
  return found;
}

double CombinedMoments::softest(Numbers numbers, double first) const {
  constexpr int halvings = 8;
  constexpr double reach = 2;
  double beyond = numbers(1), within = beyond + reach;
  numbers(1) = within;
  if (side(numbers, first) != Side::within) return HUGE_VAL;
  for (int k = 0; k < halvings; ++k) {
    numbers(1) = std::midpoint(beyond, within);
    (side(numbers, first) == Side::within ? within : beyond) = numbers(1);
  }
  return within;
}

CombinedMoments::Numbers CombinedMoments::drawn_place(std::uint64_t seed, std::uint64_t number) {
  CellRandom random(seed, number, Purpose::population);
  Numbers place;
  for (double& each : place) each = random.normal();
  return place;
}

}  // namespace rheocyte

#include "infer/time_course.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <numbers>
#include <numeric>

#include "case/channel_flow.h"
#include "infer/course_normal.h"
#include "infer/elongation_law.h"
#include "measurement/pixel_errors.h"
#include "numeric/quantile.h"

namespace rheocyte {

namespace {

constexpr int coarse = 48, fine = 40;    // points along each axis: together whole packets
constexpr double relevant = 12;          // of ln(likelihood) below the maximum
constexpr double step_of_radius = 0.03;  // in ln(radius), to both sides

std::vector<double> spaced(double first, double last, int count) {
  std::vector<double> values;
  for (int i = 0; i < count; ++i) values.push_back(std::lerp(first, last, (i + 0.5) / count));
  return values;
}

/// Quantiles of weighted values, between their middles.
Credible credible(const std::vector<double>& logarithm, const std::vector<double>& weight) {
  std::vector<std::size_t> order(logarithm.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::sort(order, {}, [&](std::size_t i) { return logarithm[i]; });
  const double all = std::accumulate(weight.begin(), weight.end(), 0.0);
  const auto quantile = [&](double fraction) {
    double below = 0, last = 0, last_value = logarithm[order.front()];
    for (const std::size_t i : order) {
      const double middle = (below + weight[i] / 2) / all;
      if (middle >= fraction) return std::lerp(last_value, logarithm[i], (fraction - last) / (middle - last));
      below += weight[i];
      last = middle;
      last_value = logarithm[i];
    }
    return last_value;
  };
  constexpr double rim = (1 - credible_fraction) / 2;
  return {std::exp(quantile(0.5)), std::exp(quantile(rim)), std::exp(quantile(1 - rim))};
}

}  // namespace

struct TimeCourse::Box {
  double min_modulus, max_modulus, min_time, max_time;  ///< logarithms, in the coordinates of the table
};

struct TimeCourse::Points {
  std::vector<double> modulus, time;  ///< coordinates
  LikelyCells cells;
  std::vector<double> log_radius;
  double min_chi_squared = 0;
};

/// What is to be added to ln|c_3| and to ln(area) of an image, for each modulus and time, to be without the tension
/// that draws it out more than such a cell of the table.
struct TimeCourse::Tension {
  Eigen::ArrayXXd log_mode_3, log_area;
  double deviation = 0;  ///< of ln|c_3|, by the law
};

TimeCourse::Tension TimeCourse::tension_of(const CourseImage& image, double radius_um,
                                           std::span<const double> log_modulus,
                                           std::span<const double> log_time) const {
  const auto rows = Eigen::Index(log_modulus.size()), columns = Eigen::Index(log_time.size());
  Tension tension{Eigen::ArrayXXd::Zero(rows, columns), Eigen::ArrayXXd::Zero(rows, columns)};
  if (std::isnan(image.mode_2)) return tension;
  const Eigen::ArrayXXd excess =
      image.mode_2 - table_.values(CourseMeasure::mode_2, radius_um, image.place_um, log_modulus, log_time).array();
  const double half_width = channel_flow_of(table_.spec().base).width_um / 2;
  const Packet mode_3 = Packet::Constant(std::abs(image.mode_3)),
               log_area = Packet::Constant(std::log(image.area_um2 / (half_width * half_width)));
  assert(excess.size() % packet_size == 0);
  double deviations = 0;
  for (Eigen::Index i = 0; i < excess.size(); i += packet_size) {
    const auto change = without_elongation({excess.reshaped().segment<packet_size>(i), mode_3, log_area});
    tension.log_mode_3.reshaped().segment<packet_size>(i) = change.log_mode_3;
    tension.log_area.reshaped().segment<packet_size>(i) = change.log_area;
    deviations += change.deviation.sum();
  }
  tension.deviation = deviations / double(excess.size());
  return tension;
}

DrawnOut TimeCourse::drawn_out(const CellImages& images, double young_modulus_kPa, double time_ms) const {
  double excess = 0, log_factor = 0, count = 0;
  for (const CourseImage& image : images) {
    if (std::isnan(image.mode_2) || std::isnan(young_modulus_kPa)) continue;
    const double radius_um = std::sqrt(image.area_um2 / std::numbers::pi);
    const auto at = coordinates_of(table_.spec(), {radius_um, young_modulus_kPa, time_ms});
    const std::vector<double> modulus(packet_size, at[1]), time{at[2]};
    const Tension tension = tension_of(image, radius_um, modulus, time);
    excess += image.mode_2 - table_.values(CourseMeasure::mode_2, radius_um, image.place_um, modulus, time)(0, 0);
    log_factor += tension.log_mode_3(0, 0);
    ++count;
  }
  if (count == 0) return {};
  return {excess / count, std::exp(log_factor / count)};
}

bool TimeCourse::has_area(double area_um2) const { return table_.has_radius(std::sqrt(area_um2 / std::numbers::pi)); }

TimeCourse::Points TimeCourse::points(const CellImages& images, const Box& box, int count) const {
  const auto moduli = spaced(box.min_modulus, box.max_modulus, count),
             times = spaced(box.min_time, box.max_time, count);
  const double fraction = 1 / double(images.size());
  Eigen::ArrayXXd log_radius = Eigen::ArrayXXd::Zero(count, count), chi_squared = log_radius;
  double guess = 0;  // of ln(radius), as if no area changed
  for (const CourseImage& image : images) guess += fraction * std::log(image.area_um2 / std::numbers::pi) / 2;
  const double radius = std::exp(guess);
  std::vector<Tension> tensions;
  for (const CourseImage& image : images) {
    const Tension& tension = tensions.emplace_back(tension_of(image, radius, moduli, times));
    const auto ratio = table_.values(CourseMeasure::area_ratio, radius, image.place_um, moduli, times);
    log_radius += fraction * (std::log(image.area_um2 / std::numbers::pi) + tension.log_area - ratio.array().log()) / 2;
  }
  for (std::size_t i = 0; i < images.size(); ++i) {
    const CourseImage& image = images[i];
    const Tension& tension = tensions[i];
    const auto at = [&](double step) -> Eigen::ArrayXXd {
      return table_.values(CourseMeasure::mode_3, radius * std::exp(step), image.place_um, moduli, times).array();
    };
    const Eigen::ArrayXXd less = at(-step_of_radius), more = at(step_of_radius);
    const Eigen::ArrayXXd expected = (less + more) / 2 + (more - less) / (2 * step_of_radius) * (log_radius - guess);
    const double deviation = std::hypot(image.deviation, image.mode_3 * tension.deviation);
    chi_squared += ((image.mode_3 * tension.log_mode_3.exp() - expected) / deviation).square();
  }
  // Where polynomials between the nodes leave what cells can be, there is no cell.
  chi_squared = chi_squared.isFinite().select(chi_squared, HUGE_VAL);
  Points points;
  points.min_chi_squared = chi_squared.minCoeff();
  for (int k = 0; k < count; ++k)
    for (int j = 0; j < count; ++j) {
      const double below = (chi_squared(j, k) - points.min_chi_squared) / 2;
      if (!(below < relevant)) continue;
      const double modulus =
          moduli[std::size_t(j)] + power_of_radius * (log_radius(j, k) - std::log(table_.spec().max_radius_um));
      points.modulus.push_back(moduli[std::size_t(j)]);
      points.time.push_back(times[std::size_t(k)]);
      points.cells.log_modulus.push_back(modulus);
      points.cells.log_viscosity.push_back(modulus + times[std::size_t(k)] - std::log(3));
      points.cells.weight.push_back(std::exp(-below));
      points.log_radius.push_back(log_radius(j, k));
    }
  return points;
}

TimeCourse::Points TimeCourse::refined_points(const CellImages& images) const {
  const auto axes = nodes_of(table_.spec());
  const Box whole{axes[1].front(), axes[1].back(), axes[2].front(), axes[2].back()};
  Points seen = points(images, whole, coarse);
  if (seen.cells.weight.empty()) return seen;
  const auto [low_modulus, high_modulus] = std::ranges::minmax(seen.modulus);
  const auto [low_time, high_time] = std::ranges::minmax(seen.time);
  const double step_modulus = (whole.max_modulus - whole.min_modulus) / coarse,
               step_time = (whole.max_time - whole.min_time) / coarse;
  return points(images,
                {std::max(low_modulus - step_modulus, whole.min_modulus),
                 std::min(high_modulus + step_modulus, whole.max_modulus),
                 std::max(low_time - step_time, whole.min_time), std::min(high_time + step_time, whole.max_time)},
                fine);
}

CourseEstimate TimeCourse::cell(const CellImages& images) const {
  const Points seen = refined_points(images);
  CourseEstimate estimate;
  if (seen.cells.weight.empty()) return estimate;
  const double all = std::accumulate(seen.cells.weight.begin(), seen.cells.weight.end(), 0.0);
  estimate.radius_um = std::exp(
      std::inner_product(seen.log_radius.begin(), seen.log_radius.end(), seen.cells.weight.begin(), 0.0) / all);
  estimate.young_modulus_kPa = credible(seen.cells.log_modulus, seen.cells.weight);
  estimate.viscosity_Pas = credible(seen.cells.log_viscosity, seen.cells.weight);
  estimate.time_ms = credible(seen.time, seen.cells.weight);
  estimate.chi_squared = seen.min_chi_squared;
  return estimate;
}

namespace {

double middle_place(const std::vector<CellImages>& cells) {
  std::vector<double> places;
  for (const CellImages& images : cells)
    for (const CourseImage& image : images) places.push_back(image.place_um);
  return median_of(places);
}

/// With c_3 multiplied by one factor at the places before the middle, and by another one from there on.
CellImages with_factors(CellImages images, double middle_um, double near, double far) {
  for (CourseImage& image : images) image.mode_3 *= image.place_um < middle_um ? near : far;
  return images;
}

Credible around(double logarithm, double error) {
  return {std::exp(logarithm), std::exp(logarithm - normal_quantile_of_credible * error),
          std::exp(logarithm + normal_quantile_of_credible * error)};
}

}  // namespace

PopulationEstimate TimeCourse::population(std::span<const CellImages> cells, const Watch& watch) const {
  const std::size_t count = std::min(cells.size(), max_cells);
  std::vector<CellImages> chosen;
  for (std::size_t i = 0; i < count; ++i) chosen.push_back(cells[i * cells.size() / count]);
  const double middle = middle_place(chosen);
  const auto points_with = [&](double near, double far) {
    std::vector<LikelyCells> seen;
    for (const CellImages& images : chosen) {
      watch.go_on();
      seen.push_back(refined_points(with_factors(images, middle, near, far)).cells);
    }
    std::erase_if(seen, [](const LikelyCells& cell) { return cell.weight.empty(); });
    return seen;
  };
  const std::vector<LikelyCells> seen = points_with(1, 1);
  if (seen.empty()) return {};
  const CourseNormal population = most_likely(seen, first_guess(seen));
  Eigen::Array2d variance = errors_of(seen, population).square();
  constexpr double off = 1 + left_by_asymmetry_law;
  for (const auto& moved : {points_with(off, 1), points_with(1, off)})
    variance += (most_likely(moved, population).mean - population.mean).square();
  const Eigen::Array2d error = variance.sqrt();
  return {around(population.mean[0], error[0]), around(population.mean[1], error[1]), std::sqrt(population.variance[0]),
          std::sqrt(population.variance[1]), seen.size()};
}

}  // namespace rheocyte

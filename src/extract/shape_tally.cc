#include "extract/shape_tally.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "events/plausibility.h"
#include "numeric/no_value.h"
#include "numeric/quantile.h"

namespace rheocyte {

namespace {

/// Least squares over the places, without what lies four robust deviations from the median.
Trend trend_of(std::span<const double> x, std::span<const double> y, double length) {
  std::vector<double> finite;
  for (const double v : y)
    if (std::isfinite(v)) finite.push_back(v);
  if (finite.size() < fewest_for_a_trend || !(length >= least_length_of_trend_um))
    return {no_value, no_value, no_value};
  const CountedSample<double> sample(finite);
  const double middle = sample.quantile(0.5), widest = 4 * robust_deviation(sample);
  double n = 0, mean_x = 0, mean_y = 0, xx = 0, xy = 0, yy = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (!std::isfinite(x[i]) || !(std::abs(y[i] - middle) <= widest)) continue;
    const double dx = x[i] - mean_x, dy = y[i] - mean_y;  // Welford's sums
    ++n;
    mean_x += dx / n;
    mean_y += dy / n;
    xx += dx * (x[i] - mean_x);
    xy += dx * (y[i] - mean_y);
    yy += dy * (y[i] - mean_y);
  }
  if (n < static_cast<double>(fewest_for_a_trend) || !(xx > 0)) return {no_value, no_value, middle};
  const double slope = xy / xx, rest = std::max(0.0, yy - slope * xy) / (n - 2);
  return {slope * length, std::sqrt(rest / xx) * length, middle};
}

/// Where a modulus lies that is not known.
enum class Side { none, softer, stiffer, anywhere };
Side side_of(ModulusState state) {
  switch (state) {
    case ModulusState::too_soft:
    case ModulusState::unstable: return Side::softer;
    case ModulusState::too_stiff:
    case ModulusState::unresolved: return Side::stiffer;
    case ModulusState::too_round:
    case ModulusState::too_elongated: return Side::anywhere;
    default: return Side::none;  // no event, or none of the table's sizes
  }
}

}  // namespace

void SidedModuli::take(ModulusState state, double modulus_kPa) {
  if (has_modulus(state) && std::isfinite(modulus_kPa)) known_.push_back(modulus_kPa);
  const Side side = side_of(state);
  beside_.below += side == Side::softer ? 1 : 0;
  beside_.above += side == Side::stiffer ? 1 : 0;
  beside_.anywhere += side == Side::anywhere ? 1 : 0;
}

JudgedModulus SidedModuli::judged() const {
  std::vector<double> logs;
  for (const double kPa : known_) logs.push_back(std::log(kPa));
  return {.median_kPa = censored_median(known_, beside_), .log_maxima = density_maxima(logs)};
}

void ShapeTally::take_moduli(const JudgedEvents& e, std::size_t i) {
  if (!e.states.empty()) {
    by_deformation_.take(e.states[i], e.modulus_kPa[i]);
    if (side_of(e.states[i]) == Side::softer) softer_areas_.push_back(e.area_um2[i]);
  }
  if (e.elongated_states.empty()) return;
  by_elongation_.take(e.elongated_states[i], e.elongation.modulus_kPa[i]);
  if (side_of(e.elongated_states[i]) == Side::softer) softer_cells_.push_back(e.cells[i]);
}

SofterCells ShapeTally::softer() const {
  SofterCells softer{.area_um2 = quantile(softer_areas_, 0.5)};
  for (int k = 0; k < softer.elongated.size(); ++k) {
    std::vector<double> along;
    for (const ElongatedCell& cell : softer_cells_) along.push_back(cell(k));
    softer.elongated(k) = quantile(along, 0.5);
  }
  return softer;
}

bool ShapeTally::is_counted(const JudgedEvents& e, std::size_t i) {
  return e.states.empty() || (e.states[i] != ModulusState::gated && e.states[i] != ModulusState::cut);
}

void ShapeTally::take(const JudgedEvents& e) {
  const auto at = [](std::span<const double> values, std::size_t i) {
    return values.empty() ? std::numeric_limits<float>::quiet_NaN() : static_cast<float>(values[i]);
  };
  for (std::size_t i = 0; i < e.excess.size(); ++i) {
    const ShapeExcess& excess = e.excess[i];
    if (is_red_cell(e.inertia_ratio[i], e.area_um2.empty() ? no_value : e.area_um2[i])) {
      red_cells_ += std::isfinite(excess.excess) ? 1 : 0;
      continue;
    }
    take_moduli(e, i);
    if (!e.area_um2.empty() && !e.deformation.empty() && is_counted(e, i))
      figures_.take(e.area_um2[i], e.deformation[i], e.inertia_ratio[i]);
    if (!std::isfinite(excess.excess)) continue;
    const ElongationBlock& drawn = e.elongation;
    if (!drawn.modulus_kPa.empty() && std::isfinite(drawn.modulus_kPa[i]))
      drawn_.push_back({drawn.modulus_kPa[i], static_cast<float>(e.modulus_kPa[i] / drawn.modulus_kPa[i]),
                        at(drawn.elongation, i), at(drawn.axial_tension_Pa, i), at(e.mode_4_excess, i),
                        at(e.mode_5_excess, i)});
    elongated_ += excess.is_elongated() ? 1 : 0;
    const OutlineTilt tilt = e.tilt.empty() ? OutlineTilt{} : e.tilt[i];
    events_.push_back({static_cast<float>(excess.excess), static_cast<float>(excess.expected), at(e.inertia_ratio, i),
                       static_cast<float>(excess.odd_fraction), at(e.area_um2, i), at(e.deformation, i),
                       at(e.mode_3, i), at(e.x_um, i), at(e.mode_4, i), at(e.y_um, i),
                       static_cast<float>(tilt.sine_mode_2), static_cast<float>(tilt.flank_slope)});
  }
}

std::vector<double> ShapeTally::column(float Event::*member) const {
  std::vector<double> values;
  for (const Event& event : events_) values.push_back(event.*member);
  return values;
}

std::vector<double> ShapeTally::drawn(float Drawn::*member) const {
  std::vector<double> values;
  for (const Drawn& cell : drawn_) values.push_back(cell.*member);
  return values;
}

JudgedShapes ShapeTally::judged() const {
  return {column(&Event::inertia_ratio), column(&Event::area), column(&Event::deformation)};
}

BesideAxis ShapeTally::beside_axis(int direction, const ChannelFlow& flow) const {
  const auto x = column(&Event::x), y = column(&Event::y), sine = column(&Event::sine_mode_2),
             flank = column(&Event::flank_slope), area = column(&Event::area), ratio = column(&Event::inertia_ratio);
  return rheocyte::beside_axis({x, y, sine, flank, area, ratio}, direction, flow);
}

ShapeVerdict ShapeTally::verdict(double pixel_size_um) const {
  ShapeVerdict v;
  v.judged = events_.size();
  v.elongated = elongated_;
  v.red_cells = red_cells_;
  const auto median = [&](float Event::*member) { return median_with_error(column(member)).value; };
  v.excess = median_with_error(column(&Event::excess));
  v.inertia_ratio = median(&Event::inertia_ratio);
  v.expected_inertia_ratio = median(&Event::expected);
  v.odd_fraction = median(&Event::odd_fraction);
  v.asymmetry = median(&Event::mode_3);
  v.radius_px = std::sqrt(median(&Event::area) / std::numbers::pi) / pixel_size_um;
  v.by_deformation = by_deformation_.judged();
  v.by_elongation = by_elongation_.judged();
  const auto x = column(&Event::x);
  auto places = x;
  std::erase_if(places, [](double place) { return !std::isfinite(place); });
  v.seen_um = central_width(places);
  v.inertia_ratio_trend = trend_of(x, column(&Event::inertia_ratio), v.seen_um);
  v.deformation_trend = trend_of(x, column(&Event::deformation), v.seen_um);
  v.asymmetry_trend = trend_of(x, column(&Event::mode_3), v.seen_um);
  v.mode_4_trend = trend_of(x, column(&Event::mode_4), v.seen_um);
  std::vector<double> moduli;
  for (const Drawn& cell : drawn_) moduli.push_back(cell.modulus_kPa);
  v.elongated_kPa = distribution_of(moduli);
  v.with_elongation = drawn_.size();
  v.modulus_ratio = median_with_error(drawn(&Drawn::ratio)).value;
  v.elongation = median_with_error(drawn(&Drawn::elongation));
  v.axial_tension_Pa = median_with_error(drawn(&Drawn::axial_tension_Pa));
  v.cortex_mode_4 = median_with_error(drawn(&Drawn::mode_4_excess));
  v.cortex_mode_5 = median_with_error(drawn(&Drawn::mode_5_excess));
  return v;
}

}  // namespace rheocyte

#include "extract/beside_axis.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <vector>

#include "extract/turning_law.h"
#include "numeric/quantile.h"

namespace rheocyte {

namespace {

constexpr std::size_t fewest_events = 15, fewest_for_centring = 20;
constexpr double least_spread_um = 0.2;            // rms
constexpr double least_way_um = 10;                // between the thirds
constexpr double least_elongation = 1.05;          // inertia ratio of cells that are called elongated
constexpr double fraction_that_decides = 1.0 / 3;  // of the tilt of a stored shape
constexpr double sure = 2;                         // standard errors
constexpr double far_from_all = 4;                 // robust standard deviations from the median: no cell of the others

using Column = std::vector<double>;

/// The events that count.
struct Events {
  Column along, y, sine, flank, area, ratio;  ///< along: downstream

  std::size_t count() const { return y.size(); }
};

/// Those whose pos_y is finite and not far from all others.
Events events_of(const PlacedOutlines& o, int direction) {
  Column places;
  for (std::size_t i = 0; i < o.y_um.size(); ++i)
    if (std::isfinite(o.y_um[i]) && std::isfinite(o.sine_mode_2[i])) places.push_back(o.y_um[i]);
  Events events;
  if (places.empty()) return events;
  const CountedSample<double> sample(places);
  const double middle = sample.quantile(0.5), widest = far_from_all * robust_deviation(sample);
  for (std::size_t i = 0; i < o.y_um.size(); ++i) {
    if (!std::isfinite(o.sine_mode_2[i]) || !(std::abs(o.y_um[i] - middle) <= widest)) continue;
    events.along.push_back(direction == 0 ? no_value : direction * o.x_um[i]);
    events.y.push_back(o.y_um[i]);
    events.sine.push_back(o.sine_mode_2[i]);
    events.flank.push_back(o.flank_slope[i]);
    events.area.push_back(o.area_um2[i]);
    events.ratio.push_back(o.inertia_ratio[i]);
  }
  return events;
}

double rms(const Column& values) {
  double mean = 0, squares = 0;
  const auto n = static_cast<double>(values.size());
  for (const double v : values) mean += v / n;
  for (const double v : values) squares += (v - mean) * (v - mean) / n;
  return std::sqrt(squares);
}

Column finite(const Column& values) {
  Column numbers;
  std::ranges::copy_if(values, std::back_inserter(numbers), [](double v) { return std::isfinite(v); });
  return numbers;
}

/// Where the line is 0, if it certainly leads there.
double zero_of(const RobustLine& line, double otherwise) {
  constexpr double certain = 3;
  if (!(std::abs(line.slope.value) > certain * line.slope.error)) return otherwise;
  return line.middle_x - line.middle.value / line.slope.value;
}

/// Slopes in the thirds of the events along the channel, and the way between them.
void read_thirds(const Events& events, BesideAxis& r) {
  const Column places = finite(events.along);
  if (places.size() < fewest_events) return;
  const CountedSample<double> sample(places);
  const std::array limits{sample.quantile(0), sample.quantile(1.0 / 3), sample.quantile(2.0 / 3), sample.quantile(1)};
  for (std::size_t third = 0; third < 3; ++third) {
    Column y, sine, flank;
    for (std::size_t i = 0; i < events.count(); ++i) {
      if (!(events.along[i] >= limits[third] && events.along[i] <= limits[third + 1])) continue;
      y.push_back(events.y[i]);
      sine.push_back(events.sine[i]);
      flank.push_back(events.flank[i]);
    }
    r.sine_slopes[third] = robust_line(y, sine).slope;
    r.flank_slopes[third] = robust_line(y, flank).slope;
  }
  r.way_um = sample.quantile(5.0 / 6) - sample.quantile(1.0 / 6);
}

/// The rms of the distances from the axis as exp(rate x): all distances, divided by it, have one distribution, so that
/// what a robust line leaves out does not change along the channel.
Estimate centring_of(const Events& events, double axis_um) {
  constexpr int iterations = 8;  // each changes the rate by 0.15 of the change before
  // A change of the rate moves the robust line of distances of a normal distribution, the largest of which hardly
  // count, by this fraction of what it moves their mean.
  constexpr double response = 0.85;
  const double middle_x = median_of(finite(events.along));
  double rate = 0, error = no_value;
  for (int k = 0; k < iterations; ++k) {
    Column distance;
    for (std::size_t i = 0; i < events.count(); ++i)
      distance.push_back(std::abs(events.y[i] - axis_um) * std::exp(-rate * (events.along[i] - middle_x)));
    const RobustLine line = robust_line(events.along, distance);
    if (line.points < fewest_for_centring || !(line.middle.value > 0)) return {};
    rate += line.slope.value / line.middle.value;
    error = line.slope.error / line.middle.value / response;
  }
  return {rate, error};
}

/// With as many decimals as the error has.
std::string text_of(const Estimate& slope) {
  const int decimals = slope.error > 0 ? std::clamp(int(std::ceil(-std::log10(slope.error))), 0, 6) : 3;
  return fmt::format("{:+.{}f} +- {:.{}f}", slope.value, decimals, slope.error, decimals);
}

}  // namespace

BesideAxis beside_axis(const PlacedOutlines& outlines, int direction, const ChannelFlow& flow) {
  const Events events = events_of(outlines, direction);
  BesideAxis r{.events = events.count()};
  if (r.events == 0) return r;
  r.spread_um = rms(events.y);
  r.inertia_ratio = median_of(finite(events.ratio));
  if (r.events < fewest_events || !(r.spread_um > least_spread_um)) return r;
  const RobustLine sine = robust_line(events.y, events.sine);
  r.sine_slope = sine.slope;
  r.flank_slope = robust_line(events.y, events.flank).slope;
  r.axis_um = zero_of(sine, median_of(events.y));
  read_thirds(events, r);
  if (!(r.way_um >= least_way_um)) return r;
  r.centring = centring_of(events, r.axis_um);
  const double radius_um = std::sqrt(median_of(finite(events.area)) / std::numbers::pi);
  r.stored_slope = tilt_of_stored_shape(radius_um, r.inertia_ratio, r.way_um, flow);
  return r;
}

Estimate BesideAxis::flank_change() const {
  const Estimate &first = flank_slopes.front(), &last = flank_slopes.back();
  return {last.value - first.value, std::hypot(first.error, last.error)};
}

BesideAxis::Turn BesideAxis::turn() const {
  const Estimate change = flank_change();
  if (!(inertia_ratio > least_elongation) || !std::isfinite(stored_slope) || !std::isfinite(change.error))
    return Turn::unknown;
  const double limit = fraction_that_decides * stored_slope;
  const auto is_within = [limit](const Estimate& e) { return std::abs(e.value) + sure * e.error < limit; };
  const auto is_above = [limit](const Estimate& e) { return e.value - sure * e.error > limit; };
  if (is_within(flank_slope) && is_within(change)) return Turn::parallel;
  if (is_above(flank_slope) || is_above(change)) return Turn::stored;
  return flank_slope.value + sure * flank_slope.error < -limit ? Turn::towards_axis : Turn::undecided;
}

bool BesideAxis::is_centring() const { return centring.value < -3 * centring.error; }

std::string BesideAxis::turn_text() const {
  if (turn() == Turn::unknown) return {};
  const std::string numbers = fmt::format(
      "slope {} per um beside the axis, change {} over {:.0f} um, where a stored shape would turn by {:+.2g}; "
      "s2 {} per um; {} events with an rms of pos_y of {:.2g} um",
      text_of(flank_slope), text_of(flank_change()), way_um, stored_slope, text_of(sine_slope), events, spread_um);
  switch (turn()) {
    case Turn::unknown: break;
    case Turn::parallel:
      return fmt::format(
          "the flanks stay parallel to the flow ({}): the elongation is renewed by the flow, not a shape that cells "
          "bring along.",
          numbers);
    case Turn::stored: return fmt::format("cells beside the axis are turned as a stored shape would be ({}).", numbers);
    case Turn::towards_axis:
      return fmt::format(
          "cells beside the axis point their noses to it ({}), as the flow there deforms elastic cells: "
          "their elongation is not a shape that they bring along.",
          numbers);
    case Turn::undecided: break;
  }
  return fmt::format("whether the elongation is stored in the cells is unknown ({}).", numbers);
}

std::string BesideAxis::centring_text() const {
  if (!std::isfinite(centring.error)) return {};
  const std::string numbers =
      fmt::format("{:.2g} um, changes by {:+.0f} +- {:.0f} % over {:.0f} um downstream", spread_um,
                  100 * centring.value * way_um, 100 * centring.error * way_um, way_um);
  if (is_centring()) return fmt::format("the cells still approach the axis: the rms of pos_y, {}.", numbers);
  return fmt::format("whether the cells still approach the axis is not seen: the rms of pos_y, {}.", numbers);
}

}  // namespace rheocyte

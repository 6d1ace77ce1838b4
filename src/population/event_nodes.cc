#include "population/event_nodes.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <map>
#include <mutex>
#include <numbers>

#include "shape/curve.h"

namespace rheocyte {
namespace {

/// In standard deviations of ln E: so far off the mean a cell is looked for at most.
constexpr double farthest_cell = 12;
constexpr int coarse_points = 20;
/// The rest of the integrand counts for less than this power of e, of its greatest value.
constexpr double negligible = 16;
/// ln of the ratio of a sphere's area and that of a deformed cell, halved: a start.
constexpr double start_offset = 0.017;

const Quadrature& shared_rule(int count) {
  static std::mutex mutex;
  static std::map<int, Quadrature> rules;
  const std::lock_guard lock(mutex);
  auto found = rules.find(count);
  if (found == rules.end()) found = rules.emplace(count, gauss_legendre(count)).first;
  return found->second;
}

/// All that enters the likelihood at one node, the radius integrated.
struct AtNode {
  double z;              ///< (e - m_e) / s_e
  double conditional;    ///< variance of u at this e
  double a, b, A, B, D;  ///< residuals of both measures and their covariance
  double det, weighted_a, weighted_b;
  double log_integrand;

  AtNode(const EventNode& node, const CellDistribution& cells) {
    z = (node.log_modulus - cells.mean_log_modulus) / cells.modulus_spread;
    conditional = cells.radius_spread * cells.radius_spread * (1 - cells.correlation * cells.correlation);
    const double du = node.log_radius - cells.mean_log_radius - cells.correlation * cells.radius_spread * z;
    const auto [Ja, Jm] = node.slope;
    a = node.residual_area + Ja * du;
    b = node.residual_measure + Jm * du;
    A = node.area_variance + Ja * Ja * conditional;
    B = node.covariance + Ja * Jm * conditional;
    D = node.measure_variance + Jm * Jm * conditional;
    det = A * D - B * B;
    weighted_a = (D * a - B * b) / det;
    weighted_b = (A * b - B * a) / det;
    log_integrand = node.log_weight - 0.5 * (z * z + weighted_a * a + weighted_b * b + std::log(det)) -
                    std::log(cells.modulus_spread);
  }
};

/// The curve of cells whose mean measured area is that of the event.
class AreaCurve {
 public:
  AreaCurve(const ForwardMap& map, const SampleEvent& event, std::array<double, 2> added)
      : map_(map), event_(event), added_(added), radii_(map.log_radii()) {
    u_ = 0.5 * (event.log_area - std::log(std::numbers::pi)) + start_offset;
    u_ = std::clamp(u_, radii_.lower, radii_.upper);
  }

  double start() const { return u_; }

  /// Neighbours are best asked for one after the other.
  EventNode at(double x) {
    MapPoint p = map_.at(u_, x);
    for (int step = 0; step < 2; ++step) {
      const double next = u_ + (event_.log_area - p.log_area) / p.log_area_by_radius;
      u_ = std::clamp(next, radii_.lower, radii_.upper);
      p = map_.at(u_, x);
    }
    const auto end = map_.soft_end(u_);
    const RadiusSlopes slope = at_constant_modulus(p, end.slope);
    return {u_,
            x + end.log_modulus + event_.log_viscosity,
            event_.log_area - p.log_area,
            event_.measure - p.measure,
            slope,
            p.area_variance + added_[0],
            p.covariance,
            p.measure_variance + added_[1],
            std::log(std::abs(1 - end.slope * p.log_area_by_height / p.log_area_by_radius))};
  }

 private:
  const ForwardMap& map_;
  const SampleEvent& event_;
  std::array<double, 2> added_;
  ForwardMap::Interval radii_;
  double u_;
};

struct Window {
  double low, high;
};

/// Where the integrand is not negligible, as far as some points tell.
Window narrowed(AreaCurve& curve, const CellDistribution& cells, Window window) {
  std::array<double, coarse_points> value;
  const double step = (window.high - window.low) / (coarse_points - 1);
  for (int k = 0; k < coarse_points; ++k)
    value[std::size_t(k)] = AtNode(curve.at(window.low + k * step), cells).log_integrand;
  const double top = *std::ranges::max_element(value);
  const auto counts = [&](double v) { return v > top - negligible; };
  const auto first = std::ranges::find_if(value, counts) - value.begin();
  const auto last = coarse_points - 1 - (std::find_if(value.rbegin(), value.rend(), counts) - value.rbegin());
  return {window.low + step * double(std::max<std::ptrdiff_t>(first - 1, 0)),
          window.low + step * double(std::min<std::ptrdiff_t>(last + 1, coarse_points - 1))};
}

}  // namespace

EventNodes::EventNodes(const ForwardMap& map, const SampleEvent& event, const CellDistribution& cells,
                       std::array<double, 2> added_variances, int nodes) {
  AreaCurve curve(map, event, added_variances);
  const auto heights = map.heights();
  const double mean = cells.mean_log_modulus - event.log_viscosity - map.soft_end(curve.start()).log_modulus,
               reach = farthest_cell * cells.modulus_spread, narrowest = 1e-3;
  Window window{std::clamp(mean - reach, heights.lower, heights.upper - narrowest), 0};
  window.high = std::clamp(mean + reach, window.low + narrowest, heights.upper);
  for (int scan = 0; scan < 2; ++scan) window = narrowed(curve, cells, window);
  const Quadrature& rule = shared_rule(nodes);
  const double width = window.high - window.low;
  for (Eigen::Index k = 0; k < rule.points.size(); ++k) {
    EventNode& node = nodes_.emplace_back(curve.at(window.low + width * rule.points(k)));
    node.log_weight += std::log(width * rule.weights(k));
  }
}

EventAnswer EventNodes::answer(const CellDistribution& cells, bool with_score) const {
  const double su = cells.radius_spread, se = cells.modulus_spread, rho = cells.correlation;
  double top = -std::numeric_limits<double>::infinity(), sum = 0;
  ParameterVector slopes = ParameterVector::Zero();
  for (const EventNode& node : nodes_) {
    const AtNode n(node, cells);
    if (n.log_integrand > top) {  // all that came before, in terms of the new greatest one
      const double before = std::exp(top - n.log_integrand);
      sum *= before;
      slopes *= before;
      top = n.log_integrand;
    }
    const double weight = std::exp(n.log_integrand - top);
    sum += weight;
    if (!with_score) continue;
    const auto [Ja, Jm] = node.slope;
    const double by_mean = n.weighted_a * Ja + n.weighted_b * Jm;
    const double by_variance = 0.5 * (by_mean * by_mean - (n.D * Ja * Ja - 2 * n.B * Ja * Jm + n.A * Jm * Jm) / n.det);
    ParameterVector score;
    score << by_mean, (n.z - by_mean * rho * su) / se, by_mean * rho * su * n.z + 2 * by_variance * n.conditional,
        n.z * n.z - 1 - by_mean * rho * su * n.z,
        (by_mean * su * n.z - 2 * by_variance * rho * su * su) * (1 - rho * rho);
    slopes += weight * score;
  }
  return {top + std::log(sum) - 1.5 * std::log(2 * std::numbers::pi), slopes / sum};
}

ShrunkenCell EventNodes::shrunken(const CellDistribution& cells) const {
  double top = -std::numeric_limits<double>::infinity(), sum = 0, e = 0, ee = 0, u = 0, uu = 0;
  for (const EventNode& node : nodes_) top = std::max(top, AtNode(node, cells).log_integrand);
  for (const EventNode& node : nodes_) {
    const AtNode n(node, cells);
    const double weight = std::exp(n.log_integrand - top);
    // At this modulus the radius is normally distributed before and after the measurement.
    const auto [Ja, Jm] = node.slope;
    const double before = cells.mean_log_radius + cells.correlation * cells.radius_spread * n.z;
    const double by_mean = n.weighted_a * Ja + n.weighted_b * Jm;
    const double known = (n.D * Ja * Ja - 2 * n.B * Ja * Jm + n.A * Jm * Jm) / n.det;
    const double mean = before + n.conditional * by_mean, variance = n.conditional * (1 - n.conditional * known);
    sum += weight;
    e += weight * node.log_modulus;
    ee += weight * node.log_modulus * node.log_modulus;
    u += weight * mean;
    uu += weight * (mean * mean + std::max(variance, 0.0));
  }
  e /= sum, ee /= sum, u /= sum, uu /= sum;
  return {u, std::sqrt(std::max(uu - u * u, 0.0)), e, std::sqrt(std::max(ee - e * e, 0.0))};
}

}  // namespace rheocyte

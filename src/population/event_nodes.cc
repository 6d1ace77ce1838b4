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

/// One number for each node.
using Nodes = Eigen::Array<double, Eigen::Dynamic, 1, 0, most_nodes, 1>;

/// All that enters the likelihood at the nodes, the radius integrated.
struct AtNodes {
  const NodeTable& nodes;
  double conditional;  ///< variance of u at one e
  Nodes z;             ///< (e - m_e) / s_e
  Nodes A, B, D;       ///< covariance of the residuals of both measures
  Nodes inverse_det, weighted_a, weighted_b;
  Nodes exponent;  ///< of the integrand, but for weights and determinants

  AtNodes(const NodeTable& table, const CellDistribution& cells) : nodes(table) {
    conditional = cells.radius_spread * cells.radius_spread * (1 - cells.correlation * cells.correlation);
    z = (of(NodeNumber::log_modulus) - cells.mean_log_modulus) / cells.modulus_spread;
    const Nodes du = of(NodeNumber::log_radius) - cells.mean_log_radius - cells.correlation * cells.radius_spread * z;
    const auto Ja = of(NodeNumber::area_slope), Jm = of(NodeNumber::measure_slope);
    const Nodes a = of(NodeNumber::residual_area) + Ja * du, b = of(NodeNumber::residual_measure) + Jm * du;
    A = of(NodeNumber::area_variance) + conditional * Ja * Ja;
    B = of(NodeNumber::covariance) + conditional * Ja * Jm;
    D = of(NodeNumber::measure_variance) + conditional * Jm * Jm;
    inverse_det = (A * D - B * B).inverse();
    weighted_a = (D * a - B * b) * inverse_det;
    weighted_b = (A * b - B * a) * inverse_det;
    exponent = -0.5 * (z * z + weighted_a * a + weighted_b * b);
  }

  NodeTable::ConstColXpr of(NodeNumber::Place number) const { return nodes.col(number); }

  Nodes log_integrand() const { return exponent + (of(NodeNumber::weight) * inverse_det.sqrt()).log(); }
  /// The integrand over exp(top), which is its greatest exponent.
  Nodes integrand(double top) const { return of(NodeNumber::weight) * inverse_det.sqrt() * (exponent - top).exp(); }
  /// Slope of ln of the integrand by the mean of u; and the information on u, of which by_variance is made.
  Nodes by_mean() const { return weighted_a * of(NodeNumber::area_slope) + weighted_b * of(NodeNumber::measure_slope); }
  Nodes information() const {
    const auto Ja = of(NodeNumber::area_slope), Jm = of(NodeNumber::measure_slope);
    return (D * Ja * Ja - 2 * B * Ja * Jm + A * Jm * Jm) * inverse_det;
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

  /// Puts the node at x into a row. The radius goes on along the curve from the last node, which is best a neighbour,
  /// and is then corrected so many times; what remains of the area counts as its residual.
  void put(double x, int corrections, NodeTable::RowXpr row) {
    const double predicted = u_ + slope_ * (x - x_);
    u_ = std::clamp(predicted, radii_.lower, radii_.upper);
    MapPoint p = map_.at(u_, x);
    for (int step = 0; step < corrections; ++step) {
      correct(p);
      p = map_.at(u_, x);
    }
    const auto end = map_.soft_end(u_);
    const RadiusSlopes slope = at_constant_modulus(p, end.slope);
    row << u_, x + end.log_modulus + event_.log_viscosity, event_.log_area - p.log_area, event_.measure - p.measure,
        slope.log_area, slope.measure, p.area_variance + added_[0], p.covariance, p.measure_variance + added_[1],
        std::abs(1 - end.slope * p.log_area_by_height / p.log_area_by_radius);
    correct(p);
    slope_ = -p.log_area_by_height / p.log_area_by_radius;
    x_ = x;
  }

 private:
  void correct(const MapPoint& p) {
    u_ = std::clamp(u_ + (event_.log_area - p.log_area) / p.log_area_by_radius, radii_.lower, radii_.upper);
  }

  const ForwardMap& map_;
  const SampleEvent& event_;
  std::array<double, 2> added_;
  ForwardMap::Interval radii_;
  double u_, x_ = 0, slope_ = 0;
};

/// At the first of many places, which no neighbour precedes.
constexpr int first_corrections = 2;

struct Window {
  double low, high;
};

/// Where the integrand is not negligible, as far as some points show.
Window narrowed(AreaCurve& curve, const CellDistribution& cells, Window window) {
  NodeTable nodes(coarse_points, int(NodeNumber::count));
  const double step = (window.high - window.low) / (coarse_points - 1);
  for (int k = 0; k < coarse_points; ++k)
    curve.put(window.low + k * step, k == 0 ? first_corrections : 0, nodes.row(k));
  std::array<double, coarse_points> value;
  Nodes::Map(value.data(), coarse_points) = AtNodes(nodes, cells).log_integrand();
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
  assert(nodes <= most_nodes);
  AreaCurve curve(map, event, added_variances);
  const auto heights = map.heights();
  const double mean = cells.mean_log_modulus - event.log_viscosity - map.soft_end(curve.start()).log_modulus,
               reach = farthest_cell * cells.modulus_spread, narrowest = 1e-3;
  Window window{std::clamp(mean - reach, heights.lower, heights.upper - narrowest), 0};
  window.high = std::clamp(mean + reach, window.low + narrowest, heights.upper);
  for (int scan = 0; scan < 2; ++scan) window = narrowed(curve, cells, window);
  const Quadrature& rule = shared_rule(nodes);
  const double width = window.high - window.low;
  nodes_.resize(rule.points.size(), int(NodeNumber::count));
  for (Eigen::Index k = 0; k < rule.points.size(); ++k)
    curve.put(window.low + width * rule.points(k), k == 0 ? first_corrections : 1, nodes_.row(k));
  nodes_.col(NodeNumber::weight) *= width * rule.weights.array();
}

EventAnswer EventNodes::answer(const CellDistribution& cells, bool with_score) const {
  const double su = cells.radius_spread, se = cells.modulus_spread, rho = cells.correlation;
  const AtNodes n(nodes_, cells);
  const double top = n.exponent.maxCoeff();
  const Nodes weight = n.integrand(top);
  const double sum = weight.sum();
  EventAnswer answer{top + std::log(sum / se) - 1.5 * std::log(2 * std::numbers::pi), ParameterVector::Zero()};
  if (!with_score) return answer;
  const Nodes by_mean = n.by_mean(), by_variance = 0.5 * (by_mean * by_mean - n.information());
  const double mean = (weight * by_mean).sum(), z = (weight * n.z).sum(), zz = (weight * n.z * n.z).sum(),
               mean_z = (weight * by_mean * n.z).sum(), variance = (weight * by_variance).sum();
  answer.score << mean, (z - rho * su * mean) / se, rho * su * mean_z + 2 * n.conditional * variance,
      zz - sum - rho * su * mean_z, (su * mean_z - 2 * rho * su * su * variance) * (1 - rho * rho);
  answer.score /= sum;
  return answer;
}

ShrunkenCell EventNodes::shrunken(const CellDistribution& cells) const {
  const AtNodes n(nodes_, cells);
  Nodes weight = n.integrand(n.exponent.maxCoeff());
  weight /= weight.sum();
  // At this modulus the radius is normally distributed before and after the measurement.
  const Nodes before = cells.mean_log_radius + cells.correlation * cells.radius_spread * n.z;
  const Nodes mean = before + n.conditional * n.by_mean(),
              variance = n.conditional * (1 - n.conditional * n.information());
  const auto moduli = n.of(NodeNumber::log_modulus);
  const double u = (weight * mean).sum(), uu = (weight * (mean * mean + variance.max(0.0))).sum(),
               e = (weight * moduli).sum(), ee = (weight * moduli * moduli).sum();
  return {u, std::sqrt(std::max(uu - u * u, 0.0)), e, std::sqrt(std::max(ee - e * e, 0.0))};
}

}  // namespace rheocyte

#include "population/kept_share.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace rheocyte {
namespace {

/// Steps of the grid in u near the edges of gates of area and elsewhere, and in x up to some stiffness and beyond it.
constexpr double fine_radius = 0.002, usual_radius = 0.004, fine_height = 0.02, coarse_height = 0.08,
                 last_fine_height = 3;
/// So far from the place of an edge for a round cell it can be, in ln(area).
constexpr double edge_zone = 0.12;
constexpr double least_chance = 1e-9;
/// In standard deviations: cells farther off the mean do not count.
constexpr double farthest = 6;

double standard_cdf(double z) { return 0.5 * std::erfc(-z / std::numbers::sqrt2); }

double chance(const SampleGates& gates, const MapPoint& p) {
  const double area_deviation = std::sqrt(p.area_variance), deviation = std::sqrt(p.measure_variance);
  const double by_area = standard_cdf((gates.greatest_log_area - p.log_area) / area_deviation) -
                         standard_cdf((gates.least_log_area - p.log_area) / area_deviation);
  const double greatest = std::min(gates.greatest_measure, gates.soft_end.at(p.log_area));
  const double by_measure =
      standard_cdf((greatest - p.measure) / deviation) - standard_cdf((gates.least_measure - p.measure) / deviation);
  return std::max(by_area, 0.0) * std::max(by_measure, 0.0);
}

}  // namespace

KeptShare::KeptShare(const KeptClass& kept) {
  const auto heights = kept.map->heights(), radii = kept.map->log_radii();
  for (double x = heights.lower; x < heights.upper;) {
    const double step = x < last_fine_height ? fine_height : coarse_height;
    heights_.push_back(x + step / 2);
    widths_.push_back(step);
    x += step;
  }
  const auto is_near_edge = [&](double u) {
    const double area = 2 * u + std::log(std::numbers::pi);
    return std::abs(area - kept.gates.least_log_area) < edge_zone ||
           std::abs(area - kept.gates.greatest_log_area) < edge_zone;
  };
  for (double u = radii.lower; u < radii.upper;) {
    const double step = is_near_edge(u) ? fine_radius : usual_radius, middle = u + step / 2;
    Row row{middle, step, kept.map->soft_end(middle).log_modulus + kept.log_viscosity, chances_.size(), 0, 0};
    for (std::size_t k = 0; k < heights_.size(); ++k) {
      const double c = chance(kept.gates, kept.map->at(middle, heights_[k]));
      if (row.count == 0 && c < least_chance) continue;
      if (row.count == 0) row.first_height = k;
      chances_.push_back(float(c));
      ++row.count;
    }
    if (row.count > 0) rows_.push_back(row);
    u += step;
  }
}

KeptShare::Answer KeptShare::answer(const CellDistribution& cells, bool with_score) const {
  const double su = cells.radius_spread, se = cells.modulus_spread, rho = cells.correlation, r2 = 1 - rho * rho;
  double sum = 0, by_u = 0, by_e = 0, by_uu = 0, by_ee = 0, by_rho = 0;
  for (const Row& row : rows_) {
    const double zu = (row.log_radius - cells.mean_log_radius) / su;
    if (std::abs(zu) > farthest) continue;
    const double middle = cells.mean_log_modulus + rho * se * zu - row.soft_end, reach = farthest * se;
    const auto begin = std::ranges::lower_bound(heights_, middle - reach) - heights_.begin(),
               end = std::ranges::lower_bound(heights_, middle + reach) - heights_.begin();
    const std::size_t first = std::max(row.first_height, std::size_t(begin)),
                      last = std::min(row.first_height + row.count, std::size_t(end));
    for (std::size_t k = first; k < last; ++k) {
      const double ze = (heights_[k] + row.soft_end - cells.mean_log_modulus) / se;
      const double form = zu * zu - 2 * rho * zu * ze + ze * ze;
      const double c =
          double(chances_[row.first + k - row.first_height]) * row.width * widths_[k] * std::exp(-0.5 * form / r2);
      sum += c;
      if (!with_score) continue;
      const double gu = (zu - rho * ze) / r2, ge = (ze - rho * zu) / r2;
      by_u += c * gu;
      by_e += c * ge;
      by_uu += c * (gu * zu - 1);
      by_ee += c * (ge * ze - 1);
      by_rho += c * (rho + zu * ze - rho * form / r2);
    }
  }
  const double share = sum / (2 * std::numbers::pi * su * se * std::sqrt(r2));
  Answer answer{std::max(share, 1e-300), ParameterVector::Zero()};
  if (with_score && sum > 0) answer.score << by_u / su / sum, by_e / se / sum, by_uu / sum, by_ee / sum, by_rho / sum;
  return answer;
}

}  // namespace rheocyte

#include "population/kept_fraction.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace rheocyte {
namespace {

/// Steps of the grid in u near the edges of gates of area and elsewhere, and in x up to some stiffness and beyond it.
constexpr double fine_radius = 0.002, usual_radius = 0.004, fine_height = 0.02, coarse_height = 0.08,
                 last_fine_height = 3;
/// So far from the place of an edge for a round cell it can be, in ln(area).
constexpr double edge_zone = 0.12;
constexpr float least_chance = 1e-9F;
/// So many steps in x are first taken at once.
constexpr std::size_t heights_between = 8;
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

KeptFraction::KeptFraction(const KeptClass& kept) {
  const auto heights = kept.map->heights(), radii = kept.map->log_radii();
  for (const auto& [end, step] :
       {std::pair(std::min(last_fine_height, heights.upper), fine_height), std::pair(heights.upper, coarse_height)}) {
    const double begin = heights_.empty() ? heights.lower : heights_.back() + stretches_.back().step / 2;
    const int count = std::max(int(std::ceil((end - begin) / step - 1e-9)), 0);
    stretches_.push_back({heights_.size(), heights_.size() + std::size_t(count), step});
    for (int k = 0; k < count; ++k) heights_.push_back(begin + (k + 0.5) * step);
  }
  const auto is_near_edge = [&](double u) {
    const double area = 2 * u + std::log(std::numbers::pi);
    return std::abs(area - kept.gates.least_log_area) < edge_zone ||
           std::abs(area - kept.gates.greatest_log_area) < edge_zone;
  };
  for (double u = radii.lower; u < radii.upper;) {
    const double step = is_near_edge(u) ? fine_radius : usual_radius, middle = u + step / 2;
    const std::vector<float> chances = chances_at(kept, middle);
    const auto first = std::ranges::find_if(chances, [](float c) { return c >= least_chance; });
    if (first != chances.end()) {
      rows_.push_back({middle, step, kept.map->soft_end(middle).log_modulus + kept.log_viscosity, chances_.size(),
                       std::size_t(chances.end() - first), std::size_t(first - chances.begin())});
      chances_.insert(chances_.end(), first, chances.end());
    }
    u += step;
  }
}

std::vector<float> KeptFraction::chances_at(const KeptClass& kept, double log_radius) const {
  std::vector<float> chances(heights_.size());
  const auto tell = [&](std::size_t k) {
    chances[k] = float(chance(kept.gates, kept.map->at(log_radius, heights_[k])));
  };
  // Between cells that pass for certain all cells do: area and measure lie between theirs.
  const std::size_t last = heights_.size() - 1;
  tell(0);
  for (std::size_t k = 0; k < last;) {
    const std::size_t next = std::min(k + heights_between, last);
    tell(next);
    const bool is_certain = chances[k] == 1 && chances[next] == 1;
    for (std::size_t inner = k + 1; inner < next; ++inner)
      if (is_certain)
        chances[inner] = 1;
      else
        tell(inner);
    k = next;
  }
  return chances;
}

KeptFraction::RowSums KeptFraction::sums_of(const Row& row, const CellDistribution& cells, double zu) const {
  const double se = cells.modulus_spread, conditional = se * std::sqrt(1 - cells.correlation * cells.correlation);
  const double middle = cells.mean_log_modulus + cells.correlation * se * zu - row.soft_end;
  const auto number_of = [&](double height) {
    return std::size_t(std::ranges::lower_bound(heights_, height) - heights_.begin());
  };
  const std::size_t first = std::max(row.first_height, number_of(middle - farthest * conditional)),
                    last = std::min(row.first_height + row.count, number_of(middle + farthest * conditional));
  RowSums sums;
  for (const Stretch& stretch : stretches_) {
    const std::size_t begin = std::max(first, stretch.begin), end = std::min(last, stretch.end);
    if (begin >= end) continue;
    // Along places of equal distance a normal density follows from two factors.
    const double step = stretch.step / conditional, shrinking = std::exp(-step * step);
    double t = (heights_[begin] - middle) / conditional;
    double density = std::exp(-0.5 * t * t) * stretch.step, factor = std::exp(-step * (t + step / 2));
    const float* chance = &chances_[row.first + begin - row.first_height];
    for (std::size_t k = begin; k < end; ++k, ++chance) {
      const double c = double(*chance) * density;
      sums.all += c;
      sums.first += c * t;
      sums.second += c * t * t;
      density *= factor;
      factor *= shrinking;
      t += step;
    }
  }
  return sums;
}

KeptFraction::Answer KeptFraction::answer(const CellDistribution& cells, bool with_score) const {
  const double su = cells.radius_spread, se = cells.modulus_spread, rho = cells.correlation,
               across = std::sqrt(1 - rho * rho);
  double sum = 0, by_u = 0, by_e = 0, by_uu = 0, by_ee = 0, by_rho = 0;
  for (const Row& row : rows_) {
    const double zu = (row.log_radius - cells.mean_log_radius) / su;
    if (std::abs(zu) > farthest) continue;
    // With t = (z_e - rho z_u) / across.
    auto [all, first, second] = sums_of(row, cells, zu);
    const double weight = row.width * std::exp(-0.5 * zu * zu);
    all *= weight, first *= weight, second *= weight;
    const double of_u = zu * all - rho / across * first;
    sum += all;
    by_u += of_u;
    by_e += first / across;
    by_uu += zu * of_u - all;
    by_ee += rho / across * zu * first + second - all;
    by_rho += rho * all + zu * across * first - rho * second;
  }
  const double fraction = sum / (2 * std::numbers::pi * su * se * across);
  Answer answer{std::max(fraction, 1e-300), ParameterVector::Zero()};
  if (with_score && sum > 0) answer.score << by_u / su / sum, by_e / se / sum, by_uu / sum, by_ee / sum, by_rho / sum;
  return answer;
}

}  // namespace rheocyte

// A forward map in closed form, much like that of cells in the channel, and samples of it.
#pragma once
#include <cmath>
#include <memory>
#include <numbers>

#include "population/sample.h"
#include "population/virtual_event.h"

namespace rheocyte::test {

/// `long_by`: an elongation, which changes both measures a little.
class InventedMap : public ForwardMap {
 public:
  explicit InventedMap(double long_by = 0) : long_by_(long_by) {}

  MapPoint at(double u, double x) const override {
    const double v = u - std::log(6.0), area = 0.04 * std::exp(-2 * x) + 0.3 * long_by_, soft = std::exp(-x);
    const double asymmetry = (0.1 + 0.02 * v) * (1 - long_by_) * soft;
    MapPoint p;
    p.log_area = 2 * u + std::log(std::numbers::pi) + area * (1 + v);
    p.log_area_by_radius = 2 + area;
    p.log_area_by_height = -0.08 * std::exp(-2 * x) * (1 + v);
    p.measure = asymmetry;
    p.measure_by_radius = 0.02 * (1 - long_by_) * soft;
    p.measure_by_height = -asymmetry;
    p.area_variance = std::pow(0.004 * std::exp(-v), 2);
    p.measure_variance = std::pow(0.003 * std::exp(-v) * (1 + asymmetry), 2);
    p.covariance = 0.3 * std::sqrt(p.area_variance * p.measure_variance);
    return p;
  }
  Interval log_radii() const override { return {std::log(3.0), std::log(10.0)}; }
  Interval heights() const override { return {0, 7}; }
  SoftEnd soft_end(double u) const override {
    const double v = u - std::log(6.0);
    return {-1 + 1.2 * v + 0.4 * v * v, 1.2 + 0.8 * v};
  }

 private:
  double long_by_;
};

/// No cell beyond the map can pass: gates as they are made for tables.
inline SampleGates whole_map() {
  SampleGates gates;
  gates.least_log_area = 2 * std::log(3.0) + std::log(std::numbers::pi) + 0.1;
  gates.greatest_log_area = 2 * std::log(10.0) + std::log(std::numbers::pi) - 0.1;
  gates.greatest_measure = 0.088;
  return gates;
}

/// Cells of about 6 um with measures of about 0.1 exp(-1) at a viscosity of 2 mPa s.
inline CellDistribution usual_cells() { return {std::log(6.0), std::log(2.0), 0.08, 0.2, 0.3}; }

/// So many events that pass the gates.
inline Sample drawn_sample(const CellDistribution& cells, int events, std::uint64_t seed, const SampleGates& gates) {
  const double log_viscosity = std::log(2.0);
  const auto map = std::make_shared<InventedMap>();
  Sample sample;
  sample.groups.push_back({map, {}});
  for (std::uint64_t k = 0; int(sample.groups[0].events.size()) < events; ++k) {
    CellRandom random(seed, k, Purpose::population);
    DrawnCell cell = drawn_cell(cells, random);
    cell.log_modulus -= log_viscosity;
    const SeenValues seen = seen_values(*map, cell, random);
    if (gates.pass(seen.log_area, seen.measure))
      sample.groups[0].events.push_back({seen.log_area, seen.measure, log_viscosity});
  }
  sample.kept.push_back({map, gates, log_viscosity, double(events)});
  return sample;
}

/// The same of cells of 17 elongations, normally distributed about 0 with a standard deviation of 1 and no further than
/// 2, with which the cells' mean goes; the longer ones have a map of their own.
inline Sample drawn_long_sample(const CellLaw& law, int events, std::uint64_t seed, const SampleGates& gates) {
  constexpr int farthest = 8;
  constexpr double step = 0.25;
  const double log_viscosity = std::log(2.0);
  Sample sample;
  for (int g = -farthest; g <= farthest; ++g) {
    sample.groups.push_back({std::make_shared<InventedMap>(0.02 * step * g), {}, step * g});
    sample.kept.push_back({sample.groups.back().map, gates, log_viscosity, 0, step * g});
  }
  int drawn = 0;
  for (std::uint64_t k = 0; drawn < events; ++k) {
    CellRandom random(seed, k, Purpose::population);
    const int g = int(std::lround(random.normal() / step));
    if (std::abs(g) > farthest) continue;
    const auto place = std::size_t(g + farthest);
    DrawnCell cell = drawn_cell(law.at(step * g), random);
    cell.log_modulus -= log_viscosity;
    const SeenValues seen = seen_values(*sample.groups[place].map, cell, random);
    if (!gates.pass(seen.log_area, seen.measure)) continue;
    sample.groups[place].events.push_back({seen.log_area, seen.measure, log_viscosity});
    sample.kept[place].count += 1;
    ++drawn;
  }
  std::erase_if(sample.groups, [](const EventGroup& group) { return group.events.empty(); });
  std::erase_if(sample.kept, [](const KeptClass& kept) { return kept.count == 0; });
  return sample;
}

}  // namespace rheocyte::test

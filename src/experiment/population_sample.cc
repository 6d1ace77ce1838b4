#include "experiment/population_sample.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "numeric/no_value.h"
#include "numeric/quantile.h"
#include "population/event_bins.h"
#include "population/single_images.h"

namespace rheocyte {
namespace {

/// Widths of the classes of elongation, less than half of its noise; of binned events, which are seen as their class.
constexpr double mode_class = 0.002, inertia_class = 0.004, binned_class_factor = 5;
/// Classes of events that have nearly the same chance to pass the gates.
constexpr std::size_t kept_classes = 8;
/// In standard deviations of the noise: so far from the table's rim its gates are.
constexpr double from_rim = 3;
/// More events are counted in bins, finer ones if there are very many.
constexpr std::size_t fewest_binned = 20000, fewest_finely_binned = 200000;
constexpr double bin_in_noise = 0.5, fine_bin_in_noise = 0.25, area_bin = 0.01, viscosity_bin = 0.005;
constexpr int limit_places = 64;

double class_width(StiffnessMeasure by, bool is_binned) {
  const double width = by == StiffnessMeasure::asymmetry ? mode_class : inertia_class;
  return is_binned ? binned_class_factor * width : width;
}

/// The mean log area of the smallest or largest cell of the map, whatever its stiffness, and its noise.
struct RimArea {
  double least = 1e300, greatest = -1e300, deviation = 0;

  RimArea(const ForwardMap& map, double u) {
    const auto [softest, stiffest] = map.heights();
    for (int k = 0; k <= 16; ++k) {
      const MapPoint p = map.at(u, softest + (stiffest - softest) * k / 16);
      least = std::min(least, p.log_area);
      greatest = std::max(greatest, p.log_area);
      deviation = std::max(deviation, std::sqrt(p.area_variance));
    }
  }
};

/// The table's own range as gates in measured values.
SampleGates gates_of_map(const ForwardMap& map) {
  const auto radii = map.log_radii();
  const RimArea smallest(map, radii.lower), largest(map, radii.upper);
  SampleGates gates;
  gates.least_log_area = smallest.greatest + from_rim * smallest.deviation;
  gates.greatest_log_area = largest.least - from_rim * largest.deviation;
  gates.soft_end.first = gates.least_log_area;
  gates.soft_end.step = (gates.greatest_log_area - gates.least_log_area) / (limit_places - 1);
  double u = radii.lower;
  for (int k = 0; k < limit_places; ++k) {
    const double wanted = gates.soft_end.first + k * gates.soft_end.step;
    MapPoint p = map.at(u, 0);
    for (int step = 0; step < 8; ++step) {
      u = std::clamp(u + (wanted - p.log_area) / p.log_area_by_radius, radii.lower, radii.upper);
      p = map.at(u, 0);
    }
    gates.soft_end.values.push_back(p.measure - from_rim * std::sqrt(p.measure_variance));
  }
  return gates;
}

void add_user_gates(const PopulationEvents& events, StiffnessMeasure by, SampleGates& gates) {
  const auto log_of = [](double area) { return area > 0 ? std::log(area) : -std::numeric_limits<double>::infinity(); };
  gates.least_log_area = std::max(gates.least_log_area, log_of(events.least_area_um2));
  gates.greatest_log_area = std::min(gates.greatest_log_area, log_of(events.greatest_area_um2));
  if (by == StiffnessMeasure::asymmetry) return;
  gates.least_measure = events.least_deformation;
  gates.greatest_measure = events.greatest_deformation;
}

/// One recording on its way.
class SampleMaker {
 public:
  SampleMaker(const PopulationEvents& events, PopulationMaps& maps, const SampleOptions& options)
      : events_(events), maps_(maps), by_(maps.by()) {
    made_.is_binned = !options.no_bins && events.events() > fewest_binned;
    made_.elongation_of_event.assign(events.events(), no_value);
    order_by_elongation();
  }

  PopulationSample make() {
    const std::size_t classes = by_ == StiffnessMeasure::deformation ? 1 : std::min(kept_classes, order_.size());
    for (std::size_t k = 0; k < classes; ++k)
      take_class(order_.size() * k / classes, order_.size() * (k + 1) / classes);
    if (made_.is_binned && !made_.sample.groups.empty()) bin();
    count_elongations_from_their_mean();
    return std::move(made_);
  }

 private:
  double elongation(std::size_t i) const {
    return by_ == StiffnessMeasure::deformation ? 0 : elongation_measure(events_, by_)[i];
  }

  void order_by_elongation() {
    const auto range = maps_.solids(events_).elongations();
    for (std::size_t i = 0; i < events_.events(); ++i) {
      const double e = elongation(i);
      if (by_ == StiffnessMeasure::deformation || (e > range.lower && e < range.upper))
        order_.push_back(i);
      else
        made_.beyond.add(e > range.lower ? TableSide::longer : TableSide::rounder);
    }
    std::ranges::stable_sort(order_, {}, [&](std::size_t i) { return elongation(i); });
  }

  /// Events of nearly one elongation: gates of their own.
  void take_class(std::size_t first, std::size_t last) {
    group_elongation_ = no_value;  // groups lie within a class
    const std::size_t first_group = group_counts_.size();
    double mean = 0, log_viscosity = 0, count = 0;
    for (std::size_t k = first; k < last; ++k) mean += elongation(order_[k]) / double(last - first);
    const auto middle = maps_.map(events_, mean);
    SampleGates gates = gates_of_map(*middle);
    add_user_gates(events_, by_, gates);
    for (std::size_t k = first; k < last; ++k) {
      const std::size_t i = order_[k];
      const SampleEvent event = sample_event(i);
      if (!gates.pass(event.log_area, event.measure)) {
        count_beyond(event, gates, *middle);
        continue;
      }
      ++count;
      log_viscosity += event.log_viscosity;
      EventGroup& group = group_of(elongation(i));
      group.events.push_back(made_.is_binned ? as_in_group(event, *group.map, elongation(i)) : event);
      double& of_group = made_.group_elongation.back();
      of_group += (elongation(i) - of_group) / ++group_counts_.back();
      made_.events.push_back(i);
      made_.elongation_of_event[i] = group_elongation_;
    }
    if (count == 0) return;
    double kept_mean = 0, kept_variance = 0;
    for (std::size_t g = first_group; g < group_counts_.size(); ++g)
      kept_mean += group_counts_[g] / count * made_.group_elongation[g];
    for (std::size_t g = first_group; g < group_counts_.size(); ++g)
      kept_variance += group_counts_[g] / count * std::pow(made_.group_elongation[g] - kept_mean, 2);
    made_.sample.kept.push_back({middle, gates, log_viscosity / count, count, kept_mean, kept_variance});
    made_.class_elongation.push_back(mean);
  }

  /// It passes the user's gates.
  void count_beyond(SampleEvent event, const SampleGates& gates, const ForwardMap& map) {
    if (event.log_area <= gates.least_log_area) return made_.beyond.add(TableSide::smaller);
    if (event.log_area >= gates.greatest_log_area) return made_.beyond.add(TableSide::larger);
    made_.beyond.add(TableSide::softer);
    event.measure = gates.soft_end.at(event.log_area);
    const ImagedCell last = cell_of_image(map, event);
    made_.softer_than.push_back(map.soft_end(last.log_radius).log_modulus + last.height + event.log_viscosity);
  }

  SampleEvent sample_event(std::size_t i) const {
    return {std::log(events_.of(SeenMeasure::area_um2)[i]), stiffness_measure(events_, by_)[i],
            std::log(events_.of(SeenMeasure::viscosity_mPas)[i])};
  }

  /// What would be measured of the event's cell if it had the elongation of its group, whose width is more than the
  /// noise: along the slope between this group's map and the next one's at constant radius and modulus.
  SampleEvent as_in_group(SampleEvent event, const ForwardMap& map, double elongation) {
    if (by_ == StiffnessMeasure::deformation) return event;
    const double width = class_width(by_, true), off = (elongation - group_elongation_) / width;
    const auto [u, x, is_in_map] = cell_of_image(map, event);
    const auto next = maps_.map(events_, group_elongation_ + width);
    const double log_modulus = map.soft_end(u).log_modulus + x;
    const MapPoint here = map.at(u, x), there = next->at(u, log_modulus - next->soft_end(u).log_modulus);
    event.log_area -= off * (there.log_area - here.log_area);
    event.measure -= off * (there.measure - here.measure);
    return event;
  }

  /// The events come in the order of their elongations.
  EventGroup& group_of(double elongation) {
    const double width = class_width(by_, made_.is_binned), middle = (std::floor(elongation / width) + 0.5) * width;
    if (made_.sample.groups.empty() || middle != group_elongation_) {
      group_elongation_ = middle;
      made_.sample.groups.push_back({maps_.map(events_, middle), {}});
      made_.group_elongation.push_back(0);
      group_counts_.push_back(0);
    }
    return made_.sample.groups.back();
  }

  /// In standard deviations of all events that are left, 0 if they are all alike. Each event has the mean elongation of
  /// its group: by the middle of the group the slopes of the cells' mean would come out too small.
  void count_elongations_from_their_mean() {
    double count = 0, mean = 0, variance = 0;
    for (const KeptClass& kept : made_.sample.kept) count += kept.count, mean += kept.count * kept.elongation;
    mean /= count;
    for (const KeptClass& kept : made_.sample.kept)
      variance += kept.count / count * (std::pow(kept.elongation - mean, 2) + kept.elongation_variance);
    const double unit = variance > 0 ? 1 / std::sqrt(variance) : 0;
    for (KeptClass& kept : made_.sample.kept) {
      kept.elongation = unit * (kept.elongation - mean);
      kept.elongation_variance *= unit * unit;
    }
    for (std::size_t g = 0; g < made_.sample.groups.size(); ++g)
      made_.sample.groups[g].elongation = unit * (made_.group_elongation[g] - mean);
    made_.elongation = {mean, unit};
  }

  void bin() {
    std::vector<double> noises;
    for (const EventGroup& group : made_.sample.groups) {
      const SampleEvent& event = group.events[group.events.size() / 2];
      noises.push_back(
          std::sqrt(group.map->at(0.5 * (event.log_area - std::log(std::numbers::pi)), 1).measure_variance));
    }
    const double fraction = events_.events() > fewest_finely_binned ? fine_bin_in_noise : bin_in_noise;
    const BinWidths widths{area_bin, fraction * median_of(noises), viscosity_bin};
    for (EventGroup& group : made_.sample.groups) group.events = binned(group.events, widths);
    made_.sample.added_area_variance = widths.log_area * widths.log_area / 12;
    made_.sample.added_measure_variance = widths.measure * widths.measure / 12;
    made_.events.clear();
  }

  const PopulationEvents& events_;
  PopulationMaps& maps_;
  StiffnessMeasure by_;
  std::vector<std::size_t> order_;
  double group_elongation_ = no_value;  ///< that of the map
  std::vector<double> group_counts_;
  PopulationSample made_;
};

}  // namespace

const std::vector<double>& stiffness_measure(const PopulationEvents& events, StiffnessMeasure by) {
  return events.of(by == StiffnessMeasure::asymmetry ? SeenMeasure::mode_3 : SeenMeasure::deformation);
}

const std::vector<double>& elongation_measure(const PopulationEvents& events, StiffnessMeasure by) {
  return events.of(by == StiffnessMeasure::asymmetry ? SeenMeasure::mode_2 : SeenMeasure::inertia_ratio);
}

PopulationSample population_sample(const PopulationEvents& events, PopulationMaps& maps, const SampleOptions& options) {
  return SampleMaker(events, maps, options).make();
}

}  // namespace rheocyte

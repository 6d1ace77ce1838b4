#include "experiment/experiment_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "case/user_error.h"
#include "events/plausibility.h"
#include "experiment/plan_words.h"
#include "infer/solid_maps.h"
#include "numeric/no_value.h"
#include "population/virtual_event.h"
#include "shelf/modulus_tables.h"

namespace rheocyte {
namespace {

constexpr std::array usual_speeds_m_s{0.04, 0.1, 0.2, 0.4};
constexpr int drawn_cells = 2000, most_told_sessions = 10;

Buffer buffer_of(const std::string& name) {
  const auto medium = medium_of_name(name);
  if (!medium)
    throw UserError(
        fmt::format("rheocyte: --medium {} has no known viscosity{}; it can be CellCarrier, CellCarrierB, 0.83% MC-PBS "
                    "or water, for example.",
                    one_line(name, 40), near_medium(name)));
  return Buffer(*medium, ViscosityModel::buyukurganci_2022);
}

/// The rates of a channel (ul/s) that are asked for, or those of the usual speeds.
std::vector<double> rates_of(const PlanOptions& options, double width_um) {
  if (!options.rates_ul_s.empty()) return options.rates_ul_s;
  std::vector<double> rates;
  for (const double speed : usual_speeds_m_s) rates.push_back(speed * width_um * width_um * 1e-3);
  return rates;
}

/// The population in one channel.
class PlannedCells {
 public:
  PlannedCells(const PlanOptions& options, const ModulusTables& tables, PlannedChannel& channel)
      : options_(options),
        channel_(channel),
        liquid_(*tables.elongated(channel.flow.exponent)),
        maps_(liquid_, channel.flow, {options.pixel_size_um}, StiffnessMeasure::asymmetry),
        map_(maps_.at(options.mode_2)),
        log_modulus_(std::log(options.young_modulus_kPa / channel.flow.viscosity_mPas)),
        u_(std::log(options.radius_um)) {}

  void tell() {
    channel_.inside = fraction_inside();
    const auto radii = map_->log_radii();
    const double x = log_modulus_ - map_->soft_end(u_).log_modulus;
    channel_.deformation = channel_.mode_3 = channel_.error_by_asymmetry = channel_.error_by_deformation = no_value;
    if (u_ < radii.lower || u_ > radii.upper || x < 0 || x > map_->heights().upper) return;
    const SolidFeatures seen = maps_.seen(maps_.cell(options_.mode_2, u_, x));
    channel_.deformation = seen.deformation;
    channel_.mode_3 = seen.modes.mode_3;
    channel_.error_by_asymmetry = event_error(*map_, u_, log_modulus_);
    const SolidMaps round(liquid_, channel_.flow, {options_.pixel_size_um}, StiffnessMeasure::deformation);
    const auto by_deformation = round.at(0);
    const double height = log_modulus_ - by_deformation->soft_end(u_).log_modulus;
    if (height < 0) return;
    channel_.error_by_deformation = event_error(*by_deformation, u_, log_modulus_);
    // What counts is the deformation by the flow alone, not that of the elongation.
    channel_.deformation = by_deformation->at(u_, height).measure;
  }

 private:
  double fraction_inside() const {
    const CellDistribution cells{u_, log_modulus_, options_.radius_spread, options_.spread, 0};
    const auto radii = map_->log_radii();
    int inside = 0;
    for (int k = 0; k < drawn_cells; ++k) {
      CellRandom random(0, std::uint64_t(k), Purpose::population);
      const DrawnCell cell = drawn_cell(cells, random);
      if (cell.log_radius < radii.lower || cell.log_radius > radii.upper) continue;
      inside += cell.log_modulus > map_->soft_end(cell.log_radius).log_modulus;
    }
    return double(inside) / drawn_cells;
  }

  const PlanOptions& options_;
  PlannedChannel& channel_;
  const ElongatedLiquid& liquid_;
  SolidMaps maps_;
  std::shared_ptr<const ForwardMap> map_;
  double log_modulus_, u_;
};

PlannedChannel planned_channel(const PlanOptions& options, const ModulusTables& tables, const std::string& medium,
                               double width_um, double rate_ul_s) {
  PlannedChannel channel;
  const Buffer buffer = buffer_of(medium);
  channel.medium = name_of(buffer.medium());
  channel.flow = {width_um, rate_ul_s, 0, buffer.flow_exponent(options.temperature_C)};
  channel.flow.viscosity_mPas = buffer.viscosity(channel.flow, options.temperature_C);
  channel.speed_m_s = rate_ul_s / (width_um * width_um) * 1e3;
  channel.wall_stress_Pa = wall_shear_stress_Pa(channel.flow);
  PlannedCells(options, tables, channel).tell();
  channel.reynolds_number = reynolds_number(buffer_density_kg_per_m3, channel.flow);
  channel.is_recommended = recommended_deformation.contains(channel.deformation) &&
                           channel.inside >= recommended_inside && channel.reynolds_number <= max_reynolds_number;
  if (channel.shows_the_cells())
    channel.sessions = sessions_for(experiment_of(options, channel), std::log1p(options.difference), options.power);
  return channel;
}

/// By how many factors d, the fraction of the cells outside and the inertia are beyond what is recommended.
double distance_from_recommended(const PlannedChannel& c) {
  const auto beyond = [](double value, double limit) { return std::max(std::log(value / limit), 0.0); };
  return beyond(c.deformation, recommended_deformation.greatest) +
         beyond(recommended_deformation.least, c.deformation) + beyond(1 - c.inside, 1 - recommended_inside) +
         beyond(c.reynolds_number, max_reynolds_number);
}

std::optional<std::size_t> best_of(const std::vector<PlannedChannel>& channels) {
  std::optional<std::size_t> best;
  const auto is_better = [](const PlannedChannel& a, const PlannedChannel& b) {
    if (a.is_recommended && b.is_recommended) return a.error_by_asymmetry < b.error_by_asymmetry;
    return distance_from_recommended(a) < distance_from_recommended(b);
  };
  for (std::size_t k = 0; k < channels.size(); ++k) {
    if (!channels[k].shows_the_cells()) continue;
    if (!best || is_better(channels[k], channels[*best])) best = k;
  }
  return best;
}

/// Of 2, 3, ... sessions with the best channel.
std::vector<double> powers(const PlanOptions& options, const PlannedChannel& channel) {
  std::vector<double> power;
  for (int sessions = 2; sessions <= most_told_sessions; ++sessions)
    power.push_back(power_of(experiment_of(options, channel), sessions, std::log1p(options.difference)));
  return power;
}

}  // namespace

bool PlannedChannel::shows_the_cells() const { return error_by_asymmetry < error_of_noisy_image; }

Experiment experiment_of(const PlanOptions& options, const PlannedChannel& channel) {
  return {options.cells, options.spread, channel.error_by_asymmetry, options.between_recordings};
}

ExperimentPlan plan_experiment(const PlanOptions& options) {
  if (options.difference == 0)
    throw UserError("rheocyte: --difference 0 cannot be found by any number of cells; give another one.");
  const ModulusTables tables({}, Section::square);
  if (!tables.elongated(1))
    throw UserError(
        "rheocyte: the table of elongated cells (elongated_*.cbor) that comes with the program is missing.");
  ExperimentPlan plan;
  for (const double width : options.widths_um)
    for (const std::string& medium : options.media)
      for (const double rate : rates_of(options, width))
        plan.channels.push_back(planned_channel(options, tables, medium, width, rate));
  plan.best = best_of(plan.channels);
  if (!plan.best) refuse_all(options, plan.channels);
  plan.power = powers(options, plan.channels[*plan.best]);
  return plan;
}

}  // namespace rheocyte

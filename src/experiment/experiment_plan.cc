#include "experiment/experiment_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "case/user_error.h"
#include "events/plausibility.h"
#include "infer/solid_maps.h"
#include "numeric/no_value.h"
#include "population/virtual_event.h"
#include "shelf/modulus_tables.h"

namespace rheocyte {
namespace {

constexpr std::array usual_speeds_m_s{0.04, 0.1, 0.2, 0.4};
constexpr int drawn_cells = 2000, most_told_sessions = 10;
constexpr double least_deformation = 0.01, greatest_deformation = 0.03, enough_inside = 0.95;
/// Of ln E by one image: the asymmetry is as great as its noise.
constexpr double error_of_noise = 1;

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

Experiment experiment_of(const PlanOptions& options, const PlannedChannel& channel) {
  return {options.cells, options.spread, channel.error_by_asymmetry, options.between_recordings};
}

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
  channel.is_recommended = channel.deformation >= least_deformation && channel.deformation <= greatest_deformation &&
                           channel.inside >= enough_inside && channel.reynolds_number <= max_reynolds_number;
  if (channel.shows_the_cells())
    channel.sessions = sessions_for(experiment_of(options, channel), std::log1p(options.difference), options.power);
  return channel;
}

/// By how many factors d, the fraction of the cells outside and the inertia are beyond what is recommended.
double distance_from_recommended(const PlannedChannel& c) {
  const auto beyond = [](double value, double limit) { return std::max(std::log(value / limit), 0.0); };
  return beyond(c.deformation, greatest_deformation) + beyond(least_deformation, c.deformation) +
         beyond(1 - c.inside, 1 - enough_inside) + beyond(c.reynolds_number, max_reynolds_number);
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

/// Which of the three terms of the error is the greatest.
std::string limit_text(const Experiment& e) {
  const double between = e.between_recordings * e.between_recordings, spread = e.spread * e.spread / e.cells,
               image = e.image_error * e.image_error / e.cells, all = between + spread + image;
  const char* const greatest =
      between >= std::max(spread, image) ? "the scatter between recordings, which more sessions alone bring down"
      : spread >= image                  ? "the spread between cells, which more cells bring down"
                                         : "the error of single images, which another channel or flow brings down";
  return fmt::format(
      "of the variance of a difference {:.0f} % come from the scatter between recordings, {:.0f} % from the spread "
      "between "
      "cells, {:.0f} % from the images: what limits is {}.",
      100 * between / all, 100 * spread / all, 100 * image / all, greatest);
}

/// The channels whose inertia the tables do not have.
void tell_inertia(ExperimentPlan& plan) {
  std::size_t channels = 0;
  double greatest = 0;
  for (const PlannedChannel& c : plan.channels)
    if (c.reynolds_number > max_reynolds_number) ++channels, greatest = std::max(greatest, c.reynolds_number);
  if (channels > 0)
    plan.lines.push_back(
        fmt::format("{} of these channels have Reynolds numbers above {:g}, up to {:.2g}, and are not recommended: the "
                    "tables hold no inertia of the liquid.",
                    channels, max_reynolds_number, greatest));
}

/// What is not as it should be, and what helps; empty of a recommended one.
std::string remedy_text(const PlannedChannel& c) {
  if (c.deformation < least_deformation)
    return "; a narrower channel, more flow or a thicker medium would deform the cells more";
  if (c.deformation > greatest_deformation || c.inside < enough_inside)
    return "; a wider channel, less flow or a thinner medium would bring more of the cells into the table";
  return {};
}

std::string percent_text(double fraction) {
  const double percent = 100 * fraction;
  return std::abs(percent) < 100 ? fmt::format("{:.3g} %", percent) : fmt::format("{:.0f} %", percent);
}

/// Differences of several hundred per cent are mostly meant as per cent.
std::string difference_text(double difference) {
  constexpr double large = 2;
  if (difference < large) return percent_text(difference);
  return fmt::format("{} (an E that is {:.3g} times as great; --difference {:g} is {:g} %)", percent_text(difference),
                     1 + difference, difference / 100, difference);
}

[[noreturn]] void refuse_all(const PlanOptions& options, const std::vector<PlannedChannel>& channels) {
  const PlannedChannel* stiff = nullptr;  // the channel that shows most of cells that are in the table
  for (const PlannedChannel& c : channels)
    if (std::isfinite(c.error_by_asymmetry) && (!stiff || c.error_by_asymmetry < stiff->error_by_asymmetry)) stiff = &c;
  if (!stiff)
    throw UserError(
        fmt::format("rheocyte: no channel of these has cells of {:g} um and {:g} kPa within the tables; cells go from "
                    "a third to nine tenths of the channel's width. Give other --width-um, --rate-ul-s or --medium.",
                    options.radius_um, options.young_modulus_kPa));
  throw UserError(fmt::format(
      "rheocyte: cells of {:g} um and {:g} kPa are too stiff to be seen in these channels: their asymmetry is at most "
      "{:.2g} of its noise in one image ({:g} um, {}, {:.3g} ul/s, {:.3g} Pa at the wall). Give a narrower --width-um, "
      "a "
      "greater --rate-ul-s or a thicker --medium: {:.2g} times the stress at the wall does.",
      options.radius_um, options.young_modulus_kPa, error_of_noise / stiff->error_by_asymmetry, stiff->flow.width_um,
      stiff->medium, stiff->flow.rate_ul_s, stiff->wall_stress_Pa, stiff->error_by_asymmetry / error_of_noise));
}

void tell_best(const PlanOptions& options, ExperimentPlan& plan) {
  const PlannedChannel& channel = plan.channels[*plan.best];
  const Experiment experiment = experiment_of(options, channel);
  const double difference = std::log1p(options.difference);
  for (int sessions = 2; sessions <= most_told_sessions; ++sessions)
    plan.power.push_back(power_of(experiment, sessions, difference));
  plan.lines.push_back(
      fmt::format("{}: {:g} um, {}, {:.3g} ul/s: d {:.3f}, c3 {:.3f}, one image tells E to {:.0f} %, {:.0f} % of the "
                  "cells inside the table{}.",
                  channel.is_recommended ? "recommended"
                                         : "best of these, but d should be 0.01 to 0.03 and 95 % of the cells inside",
                  channel.flow.width_um, channel.medium, channel.flow.rate_ul_s, channel.deformation, channel.mode_3,
                  100 * channel.error_by_asymmetry, 100 * channel.inside, remedy_text(channel)));
  const std::string sessions =
      channel.sessions > 0 ? fmt::format("{} sessions", channel.sessions) : "more than 100 sessions";
  plan.lines.push_back(
      fmt::format("a difference of {} is found with a probability of {:.0f} % by {} of {:g} cells for each "
                  "condition (paired t test); by "
                  "3 sessions with {:.0f} %, by 5 with {:.0f} %, by 8 with {:.0f} %.",
                  difference_text(options.difference), 100 * options.power, sessions, options.cells,
                  100 * plan.power[1], 100 * plan.power[3], 100 * plan.power[6]));
  plan.lines.push_back(limit_text(experiment));
  tell_inertia(plan);
}

void check_number(const char* option, double value, double least, double greatest) {
  if (!(value >= least && value <= greatest))
    throw UserError(fmt::format("rheocyte: {} {:g} must be {:g} to {:g}.", option, value, least, greatest));
}

}  // namespace

void check_options(const PlanOptions& o) {
  check_number("--radius-um", o.radius_um, 0.1, 1000);
  check_number("--young-modulus-kPa", o.young_modulus_kPa, 1e-4, 1e6);
  check_number("--spread", o.spread, 0.001, 2);
  check_number("--radius-spread", o.radius_spread, 0, 1);
  check_number("--between-recordings", o.between_recordings, 0, 2);
  check_number("--difference", o.difference, -0.99, 100);
  if (o.difference == 0)
    throw UserError("rheocyte: --difference 0 cannot be found by any number of cells; give another one.");
  check_number("--power", o.power, 0.06, 0.999);
  check_number("--cells", o.cells, 2, 1e9);
  check_number("--mode-2", o.mode_2, -0.05, 0.3);
  check_number("--pixel-size-um", o.pixel_size_um, 0.01, 10);
  for (const double width : o.widths_um) check_number("--width-um", width, 1, 10000);
  for (const double rate : o.rates_ul_s) check_number("--rate-ul-s", rate, 1e-9, 1000);
}

bool PlannedChannel::shows_the_cells() const { return error_by_asymmetry < error_of_noise; }

ExperimentPlan plan_experiment(const PlanOptions& options) {
  check_options(options);
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
  tell_best(options, plan);
  return plan;
}

namespace {

/// inf: more than are looked at; nan: of cells outside the table, or too stiff to be seen.
std::string sessions_text(const PlannedChannel& channel) {
  if (channel.sessions > 0) return std::to_string(channel.sessions);
  return channel.shows_the_cells() ? "inf" : "nan";
}

}  // namespace

std::string plan_table(const ExperimentPlan& plan) {
  std::string text(mark_of_plan);
  text +=
      "speed_m_per_s\tviscosity_mPas\twall_stress_Pa\treynolds_number\tdeformation\tmode_3\tinside\terror_by_"
      "asymmetry\t"
      "error_by_deformation\trecommended\tsessions\n";
  for (const PlannedChannel& c : plan.channels)
    text += fmt::format(
        "{:g}\t{}\t{:.4g}\t{:.3g}\t{:.3g}\t{:.3g}\t{:.3g}\t{:.3g}\t{:.3g}\t{:.3g}\t{:.3g}\t{:.3g}\t{}\t{}\n",
        c.flow.width_um, c.medium, c.flow.rate_ul_s, c.speed_m_s, c.flow.viscosity_mPas, c.wall_stress_Pa,
        c.reynolds_number, c.deformation, c.mode_3, c.inside, c.error_by_asymmetry, c.error_by_deformation,
        c.is_recommended ? "yes" : "no", sessions_text(c));
  return text;
}

}  // namespace rheocyte

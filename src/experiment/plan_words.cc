#include "experiment/plan_words.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "case/user_error.h"
#include "events/plausibility.h"

namespace rheocyte {
namespace {

/// Which of the three terms of the error is the greatest.
std::string limit_text(const Experiment& e) {
  const double between = e.between_recordings * e.between_recordings, spread = e.spread * e.spread / e.cells,
               image = e.image_error * e.image_error / e.cells, all = between + spread + image;
  const char* const greatest =
      between >= std::max(spread, image) ? "the scatter between recordings, which more sessions alone bring down"
      : spread >= image                  ? "the spread between cells, which more cells bring down"
                                         : "the error of single images, which another channel or flow brings down";
  return fmt::format(
      "variance of a difference: {:.0f} % from the scatter between recordings, {:.0f} % from the spread between cells, "
      "{:.0f} % from the images; it is limited by {}.",
      100 * between / all, 100 * spread / all, 100 * image / all, greatest);
}

/// The channels whose inertia the tables do not have; empty if there are none.
std::string channels_with_inertia_text(const std::vector<PlannedChannel>& all) {
  std::size_t channels = 0;
  double greatest = 0;
  for (const PlannedChannel& c : all)
    if (c.reynolds_number > max_reynolds_number) ++channels, greatest = std::max(greatest, c.reynolds_number);
  if (channels == 0) return {};
  return fmt::format(
      "{} of these channels have Reynolds numbers above {:g}, up to {:.2g}, and are not recommended: the tables "
      "neglect the inertia of the liquid.",
      channels, max_reynolds_number, greatest);
}

/// What is not as it should be, and what helps; empty of a recommended one.
std::string remedy_text(const PlannedChannel& c) {
  if (c.deformation < recommended_deformation.least)
    return "; a narrower channel, a higher flow rate or a more viscous medium would deform the cells more";
  if (c.deformation > recommended_deformation.greatest || c.inside < recommended_inside)
    return "; a wider channel, a lower flow rate or a less viscous medium would bring more of the cells into the table";
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
  return fmt::format("{} (an E that is {:.3g} times as large; --difference {:g} is {:g} %)", percent_text(difference),
                     1 + difference, difference / 100, difference);
}

}  // namespace

void refuse_all(const PlanOptions& options, const std::vector<PlannedChannel>& channels) {
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
      "a higher --rate-ul-s or a more viscous --medium: {:.2g} times the stress at the wall does.",
      options.radius_um, options.young_modulus_kPa, error_of_noisy_image / stiff->error_by_asymmetry,
      stiff->flow.width_um, stiff->medium, stiff->flow.rate_ul_s, stiff->wall_stress_Pa,
      stiff->error_by_asymmetry / error_of_noisy_image));
}

std::vector<std::string> plan_lines(const PlanOptions& options, const ExperimentPlan& plan) {
  const PlannedChannel& channel = plan.channels[*plan.best];
  const std::string sessions =
      channel.sessions > 0 ? fmt::format("{} sessions", channel.sessions) : "more than 100 sessions";
  std::vector<std::string> lines{
      fmt::format("{}: {:g} um, {}, {:.3g} ul/s: d {:.3f}, c3 {:.3f}, one image determines E within {:.0f} %, {:.0f} % "
                  "of the cells inside the table{}.",
                  channel.is_recommended ? "recommended"
                                         : "best of these, but d should be 0.01 to 0.03 and 95 % of the cells inside",
                  channel.flow.width_um, channel.medium, channel.flow.rate_ul_s, channel.deformation, channel.mode_3,
                  100 * channel.error_by_asymmetry, 100 * channel.inside, remedy_text(channel)),
      fmt::format("a difference of {} is found with a probability of {:.0f} % by {} of {:g} cells for each "
                  "condition (paired t test); by 3 sessions with {:.0f} %, by 5 with {:.0f} %, by 8 with {:.0f} %.",
                  difference_text(options.difference), 100 * options.power, sessions, options.cells,
                  100 * plan.power[1], 100 * plan.power[3], 100 * plan.power[6]),
      limit_text(experiment_of(options, channel))};
  if (auto inertia = channels_with_inertia_text(plan.channels); !inertia.empty()) lines.push_back(std::move(inertia));
  return lines;
}

}  // namespace rheocyte

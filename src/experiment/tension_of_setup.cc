#include "experiment/tension_of_setup.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "case/joined.h"
#include "experiment/unlike_recordings.h"
#include "numeric/quantile.h"

namespace rheocyte {
namespace {

constexpr std::size_t fewest_recordings = 3;
/// Of their mean: tensions that differ by no more are one. 35 samples of HL60 cells under drugs and in several
/// osmolarities lie within -10 and +7 % of theirs.
constexpr double most_from_mean = 0.1;

/// Recordings with a tension that were measured alike.
std::vector<RecordingReports> setups_of(const std::vector<RecordingReport>& recordings) {
  std::vector<RecordingReports> setups;
  for (const RecordingReport& r : recordings) {
    if (!r.estimate(PopulationQuantity::axial_tension)) continue;
    const auto alike = std::ranges::find_if(setups, [&](const RecordingReports& setup) {
      return differences_within({setup.front(), &r}).empty();
    });
    if (alike == setups.end())
      setups.push_back({&r});
    else
      alike->push_back(&r);
  }
  return setups;
}

/// Mean of logarithms, and the standard deviation between them; at least two.
struct LogMean {
  double value = no_value, deviation = no_value;
};
LogMean mean_of_logs(const std::vector<double>& logs) {
  const double mean = mean_of(logs);
  double squares = 0;
  for (const double log : logs) squares += std::pow(log - mean, 2) / double(logs.size() - 1);
  return {mean, std::sqrt(squares)};
}

/// Mean of ln of the ratios that recordings have, and its standard error.
struct MeanRatio {
  double log = no_value, error = no_value;
};
MeanRatio mean_ratio(const RecordingReports& recordings, Median EffectiveCell::*ratio) {
  std::vector<double> logs;
  for (const RecordingReport* r : recordings)
    if (r->effective && std::isfinite(((*r->effective).*ratio).value))
      logs.push_back(std::log(((*r->effective).*ratio).value));
  if (logs.size() < fewest_recordings) return {};
  const auto [mean, deviation] = mean_of_logs(logs);
  return {mean, deviation / std::sqrt(double(logs.size()))};
}

/// Cells of all sizes are under one tension; empty where that is not known.
std::string sentence_on_sizes(const RecordingReports& setup) {
  const MeanRatio modulus = mean_ratio(setup, &EffectiveCell::large_over_small_modulus),
                  tension = mean_ratio(setup, &EffectiveCell::large_over_small_tension);
  if (!std::isfinite(modulus.log) || !std::isfinite(tension.log)) return {};
  return fmt::format(
      "cells of the largest third of the areas over those of the smallest: E_eff {:.3f} +- {:.3f}, axial tension "
      "{:.3f} +- {:.3f}: {}",
      std::exp(modulus.log), std::exp(modulus.log) * modulus.error, std::exp(tension.log),
      std::exp(tension.log) * tension.error,
      std::abs(tension.log) < std::log1p(most_from_mean) ? "one tension for all sizes, as the model requires"
                                                         : "not one tension for all sizes, as the model requires; the "
                                                           "modulus may depend on the size for this reason only");
}

/// ln of the axial tension over the wall shear stress, of a recording that has a tension.
double log_over_wall_stress(const RecordingReport& r) {
  return r.estimate(PopulationQuantity::axial_tension)->mean.value - std::log(r.wall_stress_Pa());
}
double log_over_wall_stress(const RecordingReports& setup) {
  std::vector<double> logs;
  for (const RecordingReport* r : setup) logs.push_back(log_over_wall_stress(*r));
  return mean_of(logs);
}

/// What several set-ups have of the wall shear stress as tension; empty of one.
std::string sentence_on_setups(const std::vector<RecordingReports>& setups) {
  if (setups.size() < 2) return {};
  std::vector<std::string> texts;
  std::vector<double> logs;
  for (const RecordingReports& setup : setups) {
    const ChannelFlow& flow = setup.front()->conditions.flow;
    logs.push_back(log_over_wall_stress(setup));
    texts.push_back(fmt::format("{:.2f} ({:g} um, {:g} ul/s)", std::exp(logs.back()), flow.width_um, flow.rate_ul_s));
  }
  const auto [smallest, largest] = std::ranges::minmax(logs);
  return fmt::format("axial tension over the wall shear stress: {}: {}", joined(texts, ", "),
                     largest - smallest < std::log1p(most_from_mean)
                         ? "the same in all set-ups"
                         : "not the same in all set-ups, so part of a difference of their moduli may be due to it");
}

std::string sentence_on(const RecordingReports& setup) {
  std::vector<double> logs;
  for (const RecordingReport* r : setup) logs.push_back(r->estimate(PopulationQuantity::axial_tension)->mean.value);
  const auto [least, greatest] = std::ranges::minmax(logs);
  const double mean = mean_of(logs);
  const bool is_one = std::max(std::expm1(greatest - mean), -std::expm1(least - mean)) < most_from_mean;
  return fmt::format(
      "axial tension in {} recordings of one set-up: {:.0f} Pa ({:.0f} to {:.0f}), {:.2f} of the wall "
      "shear stress: {}",
      setup.size(), std::exp(mean), std::exp(least), std::exp(greatest), std::exp(log_over_wall_stress(setup)),
      is_one ? "one tension, as the model requires"
             : "not one tension; the recordings were not measured alike, or their cells differ in the "
               "proportions of bulk and cortex");
}

}  // namespace

std::optional<SharedTension> tension_of_setup(std::span<const RecordingReport> recordings,
                                              const RecordingReport& recording) {
  std::vector<double> logs;
  for (const RecordingReport& r : recordings)
    if (r.estimate(PopulationQuantity::axial_tension) && differences_within({&recording, &r}).empty())
      logs.push_back(log_over_wall_stress(r));
  if (logs.size() < 2) return {};
  const auto [mean, deviation] = mean_of_logs(logs);
  return SharedTension{mean, deviation};
}

std::vector<std::string> tensions_of_setups(const std::vector<RecordingReport>& recordings) {
  std::vector<std::string> sentences;
  const auto setups = setups_of(recordings);
  for (const RecordingReports& setup : setups) {
    if (setup.size() < fewest_recordings) continue;
    sentences.push_back(sentence_on(setup));
    sentences.push_back(sentence_on_sizes(setup));
  }
  sentences.push_back(sentence_on_setups(setups));
  std::erase_if(sentences, &std::string::empty);
  return sentences;
}

}  // namespace rheocyte

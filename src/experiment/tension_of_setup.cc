#include "experiment/tension_of_setup.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "experiment/unlike_recordings.h"

namespace rheocyte {
namespace {

constexpr std::size_t fewest_recordings = 3;
/// Of their mean: tensions that differ by no more are one. 35 samples of HL60 cells under drugs and in several
/// osmolarities lie within -10 and +7 % of theirs.
constexpr double most_from_mean = 0.1;

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
  std::erase_if(setups, [](const RecordingReports& setup) { return setup.size() < fewest_recordings; });
  return setups;
}

std::string sentence_on(const RecordingReports& setup) {
  std::vector<double> logs;
  for (const RecordingReport* r : setup) logs.push_back(r->estimate(PopulationQuantity::axial_tension)->mean.value);
  const auto [least, greatest] = std::ranges::minmax(logs);
  double mean = 0, stress = 0;
  for (std::size_t k = 0; k < setup.size(); ++k) {
    mean += logs[k] / double(setup.size());
    stress += std::log(setup[k]->wall_stress_Pa()) / double(setup.size());
  }
  const bool is_one = std::max(std::expm1(greatest - mean), -std::expm1(least - mean)) < most_from_mean;
  return fmt::format(
      "axial tension in {} recordings of one set-up: {:.0f} Pa ({:.0f} to {:.0f}), {:.2f} of the wall "
      "shear stress: {}",
      setup.size(), std::exp(mean), std::exp(least), std::exp(greatest), std::exp(mean - stress),
      is_one ? "one tension, as the model requires"
             : "not one tension; the recordings were not measured alike, or their cells differ in the "
               "proportions of bulk and cortex");
}

}  // namespace

std::optional<SharedTension> tension_of_setup(std::span<const RecordingReport> recordings,
                                              const RecordingReport& recording) {
  std::vector<double> logs;
  for (const RecordingReport& r : recordings) {
    const QuantityEstimate* const tension = r.estimate(PopulationQuantity::axial_tension);
    if (tension && differences_within({&recording, &r}).empty())
      logs.push_back(tension->mean.value - std::log(r.wall_stress_Pa()));
  }
  if (logs.size() < 2) return {};
  double mean = 0, squares = 0;
  for (const double log : logs) mean += log / double(logs.size());
  for (const double log : logs) squares += std::pow(log - mean, 2) / double(logs.size() - 1);
  return SharedTension{mean, std::sqrt(squares)};
}

std::vector<std::string> tensions_of_setups(const std::vector<RecordingReport>& recordings) {
  std::vector<std::string> sentences;
  for (const RecordingReports& setup : setups_of(recordings)) sentences.push_back(sentence_on(setup));
  return sentences;
}

}  // namespace rheocyte

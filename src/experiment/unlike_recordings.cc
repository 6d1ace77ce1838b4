#include "experiment/unlike_recordings.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "case/joined.h"

namespace rheocyte {
namespace {

/// Numbers nearer than this to each other are those of one set-up.
constexpr double relative_tolerance = 0.02, temperature_tolerance = 1;

/// Words for a number of each recording, the same where numbers are alike.
struct NumberInWords {
  double relative = 0, absolute = 0;
  std::string_view unit;

  std::vector<std::string> of(const std::vector<double>& numbers) const {
    std::vector<double> sorted = numbers;
    std::erase_if(sorted, [](double number) { return !std::isfinite(number); });
    std::ranges::sort(sorted);
    std::vector<double> distinct;
    for (const double number : sorted)
      if (distinct.empty() || number - distinct.back() > absolute + relative * distinct.back())
        distinct.push_back(number);
    std::vector<std::string> words;
    for (const double number : numbers) {
      const auto above = std::ranges::upper_bound(distinct, number);
      words.push_back(std::isfinite(number) ? fmt::format("{:.3g} {}", *std::prev(above), unit) : std::string());
    }
    return words;
  }
};

enum Trait { trait_width, trait_rate, trait_medium, trait_temperature, trait_pixel, traits };
constexpr std::array<std::string_view, traits> trait_names{"channel width", "flow rate", "medium", "temperature",
                                                           "pixel size"};
/// By trait and recording, in words.
using Traits = std::array<std::vector<std::string>, traits>;

Traits traits_of(const RecordingReports& recordings) {
  const auto words = [&](const NumberInWords& in_words, auto number) {
    std::vector<double> numbers;
    for (const RecordingReport* r : recordings) numbers.push_back(number(*r));
    return in_words.of(numbers);
  };
  Traits all;
  all[trait_width] = words({relative_tolerance, 0, "um"}, [](const auto& r) { return r.conditions.flow.width_um; });
  all[trait_rate] = words({relative_tolerance, 0, "ul/s"}, [](const auto& r) { return r.conditions.flow.rate_ul_s; });
  all[trait_temperature] = words({0, temperature_tolerance, "degC"}, [](const auto& r) { return r.temperature_C; });
  all[trait_pixel] = words({relative_tolerance, 0, "um"}, [](const auto& r) { return r.pixel_size_um; });
  // A liquid whose viscosity was given is known by that.
  all[trait_medium] = words({relative_tolerance, 0, "mPa s"},
                            [](const auto& r) { return r.medium.empty() ? r.median_viscosity_mPas : no_value; });
  for (std::size_t k = 0; k < recordings.size(); ++k)
    if (all[trait_medium][k].empty()) all[trait_medium][k] = recordings[k]->medium;
  return all;
}

std::string difference_text(Trait trait, std::set<std::string> kinds) {
  kinds.erase(std::string());  // unknown
  return kinds.size() < 2 ? std::string() : fmt::format("{} ({})", trait_names[trait], joined(kinds, " and "));
}

/// Of the traits in which `differ` finds a difference.
template <class Differ>
std::string differences(const Traits& all, const Differ& differ) {
  std::vector<std::string> found;
  for (int t = 0; t < traits; ++t) {
    const auto& words = all[std::size_t(t)];
    if (!differ(words)) continue;
    if (auto text = difference_text(Trait(t), {words.begin(), words.end()}); !text.empty()) found.push_back(text);
  }
  return joined(found, ", ");
}

}  // namespace

std::string differences_within(const RecordingReports& recordings) {
  return differences(traits_of(recordings), [](const auto&) { return true; });
}

std::string differences_between(const RecordingReports& some, const RecordingReports& others) {
  RecordingReports all = some;
  all.insert(all.end(), others.begin(), others.end());
  return differences(traits_of(all), [&](const std::vector<std::string>& words) {
    const auto middle = words.begin() + std::ptrdiff_t(some.size());
    return std::set(words.begin(), middle) != std::set(middle, words.end());
  });
}

bool share_channel_and_medium(const RecordingReports& recordings) {
  const Traits all = traits_of(recordings);
  const auto are_equal = [](const std::vector<std::string>& words) {
    return std::ranges::adjacent_find(words, std::not_equal_to()) == words.end();
  };
  return are_equal(all[trait_width]) && are_equal(all[trait_medium]);
}

}  // namespace rheocyte

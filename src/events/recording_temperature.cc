#include "events/recording_temperature.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "case/refuse_path.h"
#include "case/user_error.h"
#include "numeric/no_value.h"
#include "numeric/number_from_chars.h"
#include "numeric/quantile.h"

namespace rheocyte {

namespace {

constexpr double kelvin_at_0_celsius = 273.15;

std::string hint_of_kelvin(double value) {
  const double celsius = value - kelvin_at_0_celsius;
  return is_possible_temperature(celsius) ? fmt::format(" ({:g} K are {:.4g} degC)", value, celsius) : "";
}

std::string range_text() { return fmt::format("{:g} to {:g} degC", lowest_temperature_C, highest_temperature_C); }

double given(const std::string& text, const char* option) {
  double value = no_value;
  const auto [end, error] = number_from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size() || !std::isfinite(value))
    throw UserError(fmt::format("rheocyte: {} {}: give degrees Celsius{}.", option, one_line(text, 60),
                                option == std::string_view("--temperature") ? ", feature or metadata" : ""));
  if (!is_possible_temperature(value))
    throw UserError(fmt::format("rheocyte: {} {}: a buffer in a channel has {}{}.", option, one_line(text, 60),
                                range_text(), hint_of_kelvin(value)));
  return value;
}

/// The temperatures in the feature temp.
struct OfEvents {
  double median = no_value;    ///< of the possible ones
  double example = median;     ///< one that is a number and impossible
  std::size_t impossible = 0;  ///< events without a possible one
};

OfEvents temperatures_of_events(const Recording& recording) {
  std::vector<double> values(recording.events());
  recording.read_scalar("temp", 0, values);
  OfEvents found;
  for (const double celsius : values)
    if (std::isfinite(celsius) && !is_possible_temperature(celsius)) found.example = celsius;
  found.impossible = std::erase_if(values, [](double celsius) { return !is_possible_temperature(celsius); });
  if (!values.empty()) found.median = median_of(values);
  return found;
}

std::string what_is_wrong(const OfEvents& events) {
  return std::isfinite(events.example)
             ? fmt::format("impossible (for example {:g} degC{})", events.example, hint_of_kelvin(events.example))
             : "no numbers";
}

/// Goes through the ways to a temperature, from the best to the last.
class Search {
 public:
  Search(const MeasuringOptions& options, const Recording& recording) : options_(options), recording_(recording) {
    if (recording.has_scalar("temp")) events_ = temperatures_of_events(recording);
  }

  RecordingTemperature run() {
    const std::string& wish = options_.temperature;
    if (!wish.empty() && wish != "feature" && wish != "metadata") return found(TemperatureSource::given, as_given());
    if (wish == "feature" && !events_)
      refuse("has no temperature of each event; leave --temperature out, or give it in degrees Celsius.");
    if (wish != "metadata" && events_ && take_events()) {
      const double others = of_single_events();
      return {TemperatureSource::feature, events_->median, others, notes_};
    }
    if (wish == "feature") refuse(notes_.back());
    if (const auto stored = of_metadata()) return found(TemperatureSource::metadata, *stored);
    if (!options_.temperature_if_missing.empty()) return found(TemperatureSource::given, if_missing());
    std::string sentences;
    for (const auto& note : notes_) sentences += note + " ";
    refuse((sentences.empty() ? "contains no temperature, on which the viscosity depends. " : sentences) +
           "Give it in degrees Celsius (--temperature-if-missing), or the viscosity (--viscosity-mPas).");
  }

 private:
  [[noreturn]] void refuse(const std::string& reason) const { refuse_path(recording_.file(), reason); }

  double as_given() {
    const double value = given(options_.temperature, "--temperature");
    const auto stored = recording_.metadata().number("setup:temperature");
    const bool of_events = events_ && std::isfinite(events_->median);
    if (of_events || (stored && is_possible_temperature(*stored)))
      notes_.push_back(
          fmt::format("--temperature {:g} replaces the recorded temperature ({:.4g} degC{}); --temperature-if-missing "
                      "keeps recorded temperatures.",
                      value, of_events ? events_->median : *stored, of_events ? ", median of the events" : ""));
    return value;
  }

  bool take_events() {
    if (events_->impossible == recording_.events()) {
      notes_.push_back(fmt::format("the temperatures of the events are {}.", what_is_wrong(*events_)));
      return false;
    }
    return true;
  }

  double of_single_events() {
    if (events_->impossible == 0) return no_value;
    const std::string what = what_is_wrong(*events_);
    if (options_.temperature_if_missing.empty()) {
      notes_.push_back(
          fmt::format("{} events have no modulus, because their temperatures are {}.", events_->impossible, what));
      return no_value;
    }
    const double wanted = if_missing();
    const auto stored = recording_.metadata().number("setup:temperature");
    const bool is_stored = stored && is_possible_temperature(*stored);
    const double taken = is_stored ? *stored : wanted;
    notes_.push_back(fmt::format("{} events have temperatures that are {}; for them {:g} degC is used{}.",
                                 events_->impossible, what, taken, is_stored ? ", setup:temperature" : ""));
    return taken;
  }

  double if_missing() const { return given(options_.temperature_if_missing, "--temperature-if-missing"); }

  RecordingTemperature found(TemperatureSource from, double celsius) const { return {from, celsius, no_value, notes_}; }

  std::optional<double> of_metadata() {
    const auto& metadata = recording_.metadata();
    const auto stored = metadata.number("setup:temperature");
    if (!stored) {
      if (const auto text = metadata.text("setup:temperature"))
        notes_.push_back(fmt::format("setup:temperature is \"{}\", which is not a number.", one_line(*text, 40)));
      return std::nullopt;
    }
    if (is_possible_temperature(*stored)) {
      if (!notes_.empty()) notes_.back() += fmt::format(" setup:temperature, {:g} degC, is used.", *stored);
      return stored;
    }
    notes_.push_back(fmt::format("setup:temperature is {:g}, but a buffer in a channel has {}{}.", *stored,
                                 range_text(), hint_of_kelvin(*stored)));
    return std::nullopt;
  }

  const MeasuringOptions& options_;
  const Recording& recording_;
  std::optional<OfEvents> events_;
  std::vector<std::string> notes_;
};

}  // namespace

void check_temperatures(const MeasuringOptions& options) {
  const std::string& wish = options.temperature;
  if (!wish.empty() && wish != "feature" && wish != "metadata") static_cast<void>(given(wish, "--temperature"));
  if (!options.temperature_if_missing.empty())
    static_cast<void>(given(options.temperature_if_missing, "--temperature-if-missing"));
}

RecordingTemperature temperature_of(const MeasuringOptions& options, const Recording& recording) {
  return Search(options, recording).run();
}

}  // namespace rheocyte

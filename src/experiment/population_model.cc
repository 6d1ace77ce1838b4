#include "experiment/population_model.h"

#include <fmt/format.h>

#include <cmath>

#include "case/refuse_path.h"
#include "case/user_error.h"
#include "experiment/combined_populations.h"
#include "experiment/effective_populations.h"
#include "experiment/population_recordings.h"
#include "experiment/solid_populations.h"

namespace rheocyte {

std::unique_ptr<PopulationModel> population_model(const PopulationOptions& options) {
  if (options.model == "cortex") {
    if (options.shared_spread)
      throw UserError(
          "rheocyte: --shared-spread is for solids; cells with a cortex have their spreads recording by recording.");
    return std::make_unique<CombinedPopulations>(options);
  }
  if (options.model == "effective") {
    if (options.shared_spread)
      throw UserError("rheocyte: --shared-spread is for solids; --model effective takes the median cell alone.");
    return std::make_unique<EffectivePopulations>(options);
  }
  if (options.model.empty() || options.model == "solid") {
    if (options.section)
      throw UserError(
          "rheocyte: --section is for --model cortex and effective; solids have tables of the square channel itself.");
    if (options.outline_noise_um.value_or(0) > 0 && stiffness_measure_of(options) != StiffnessMeasure::asymmetry)
      throw UserError(
          fmt::format("rheocyte: --outline-noise-um and --by {} contradict each other: its effect is known only for "
                      "whole outlines. Leave one of them out.",
                      options.by));
    return std::make_unique<SolidPopulations>(options);
  }
  throw UserError(
      fmt::format("rheocyte: --model {}: it must be solid, cortex or effective.", one_line(options.model, 40)));
}

void check_events_of_population(const RecordingReport& report) {
  constexpr std::size_t fewest_population_events = 20;
  if (report.fitted_events < fewest_population_events)
    refuse_path(report.recording, fmt::format("has {} events that the gates and the table of its cells leave, of {}; a "
                                              "population needs at least {}.",
                                              report.fitted_events, report.recorded, fewest_population_events));
}

void tell_beyond(RecordingReport& r) {
  constexpr double worth_a_word = 0.25;
  const std::size_t beyond = r.beyond.all(), events = r.seen_events();
  if (double(beyond) > worth_a_word * double(events))
    r.warnings.push_back(fmt::format(
        "{} of {} events ({}) lie beyond the cells of the table, or too near its ends; the population is that of all "
        "cells as far as {} describes it.",
        beyond, events, r.beyond.shares(events),
        r.continued_events > 0 ? "the table, which goes straight on to them," : "the distribution of the others"));
}

void refuse_most_beyond(PopulationQuantity quantity, const std::optional<double>& log_bound, RecordingReport& r) {
  const std::string majority = r.beyond.majority(r.seen_events());
  if (majority.empty()) return;
  r.is_beyond = true;
  const QuantityWords words = words_of(quantity);
  std::string bound = "the others are a tail of all cells, whose median is unknown";
  if (log_bound && std::isfinite(*log_bound)) {
    r.bound = {quantity, *log_bound};
    bound = fmt::format("the median of {} is below {:.3g} {}", words.symbol, std::exp(*log_bound), words.unit);
  }
  r.failure = fmt::format(
      "{} than the cells of the table {}, or too near its end: {}. --model effective reaches softer and longer cells; "
      "another channel, flow rate or medium brings them into the table, `rheocyte plan` says which.",
      majority, r.table, bound);
}

void refuse_tail(const RecordingReport& report, double kept_fraction) {
  refuse_path(report.recording, fmt::format("the gates leave a tail of its cells, {:.1g} of them; nothing certain can "
                                            "be said of the rest. Widen the gates.",
                                            kept_fraction));
}

}  // namespace rheocyte

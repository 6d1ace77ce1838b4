// Of what cells the populations of recordings are: each model reports what it can, in the same numbers.
#pragma once
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "events/options.h"
#include "experiment/population_events.h"
#include "experiment/recording_report.h"
#include "store/watch.h"

namespace rheocyte {

class PopulationModel {
 public:
  virtual ~PopulationModel() = default;
  virtual std::string_view name() const = 0;
  /// As it stands in the records.
  virtual std::string_view elongation_text() const = 0;
  virtual std::string table(const PopulationEvents& events) = 0;
  /// What the recordings have in common, in words, with relative errors.
  virtual std::string systematic_errors(std::span<const RecordingReport> recordings) const = 0;
  /// Fits the population of a recording and adds what is found, or why there are no numbers; `watch` is asked from
  /// step to step where that takes long. UserError: too few events, none inside the gates, gates that leave a tail.
  virtual void fit(const PopulationEvents& events, RecordingReport& report, const Watch& watch) = 0;
  /// Whether gates on the shape select cells beyond what the model knows of: `compare` follows a fit then.
  virtual bool lacks_shape_gates() const { return false; }
  /// With the events that pass if gates on the shape are lifted.
  virtual void compare(const PopulationEvents& without_shape_gates, RecordingReport& report) const {
    static_cast<void>(without_shape_gates), static_cast<void>(report);
  }
  /// Once all were fitted, in the same order: what they share.
  virtual void share(std::span<RecordingReport> recordings) { static_cast<void>(recordings); }
};

/// `--model`: solids, or solids with a cortex. UserError if it is none, or a table is missing, or does not go with it.
std::unique_ptr<PopulationModel> population_model(const PopulationOptions& options);

/// UserError below the events that a population needs.
void check_events_of_population(const RecordingReport& report);

/// Where the table lacks many, the population is determined by the shape of the rest: a warning.
void tell_beyond(RecordingReport& report);

/// If most events lie on one side of the table the others are a tail, which does not describe the rest: no numbers.
/// `log_bound`: below it ln of the median of the quantity is known to lie, if it is.
void refuse_most_beyond(PopulationQuantity quantity, const std::optional<double>& log_bound, RecordingReport& report);

/// UserError: gates that keep less than least_kept_fraction.
[[noreturn]] void refuse_tail(const RecordingReport& report, double kept_fraction);

}  // namespace rheocyte

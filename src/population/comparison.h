// Whether the mean stiffness of two conditions differs, by their recordings (docs/theory-populations.md, eq:paired and
// eq:welch).
#pragma once
#include <optional>
#include <span>

#include "numeric/no_value.h"

namespace rheocyte {

/// Mean of ln E of one recording and its sampling variance.
struct RecordingMean {
  double value, variance;
};

/// Of the mean difference of ln E, treated - control; NaN where there is none.
struct ConditionDifference {
  double value = no_value;
  double standard_error = no_value, freedom = no_value;  ///< by the scatter of the recordings
  /// The wider of the intervals by Student's t and by sampling, and the greater p of both: recordings scatter at least
  /// as their sampling has it (eq:wider).
  double lower = no_value, upper = no_value, p = no_value;
  bool is_by_sampling = false;       ///< these are those of the sampling
  double sampling_error = no_value;  ///< as if recordings did not scatter
  double sampling_lower = no_value, sampling_upper = no_value;
  /// With a standard deviation between recordings that is known from earlier experiments.
  double known_lower = no_value, known_upper = no_value, known_p = no_value;
};

struct ComparisonSettings {
  double level = 0.95;
  std::optional<double> between_recordings;  ///< standard deviation of ln E
};

/// Of sessions: control and treated have equally many recordings (asserted), of which each two belong together.
ConditionDifference paired_difference(std::span<const RecordingMean> control, std::span<const RecordingMean> treated,
                                      const ComparisonSettings& settings);
/// Welch's test with Satterthwaite's degrees of freedom.
ConditionDifference unpaired_difference(std::span<const RecordingMean> control, std::span<const RecordingMean> treated,
                                        const ComparisonSettings& settings);

/// Standard deviation of the means beyond their sampling errors: restricted maximum likelihood, and the interval by the
/// generalised chi-squared of the scatter. NaN of fewer than two.
struct ScatterBetween {
  double deviation = no_value, lower = no_value, upper = no_value;
};
ScatterBetween scatter_between(std::span<const RecordingMean> means, double level);

}  // namespace rheocyte

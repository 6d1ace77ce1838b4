// How many cells and sessions show a difference (docs/theory-populations.md, eq:power).
#pragma once

namespace rheocyte {

/// An experiment in pairs of recordings, one pair a session. Spreads are standard deviations of ln E.
struct Experiment {
  double cells = 500;             ///< per recording
  double spread = 0.2;            ///< between cells
  double image_error = 0;         ///< of one image's ln E
  double between_recordings = 0;  ///< beyond sampling
};

/// Standard error of the mean difference over so many sessions.
double error_of_difference(const Experiment& experiment, int sessions);
/// That the paired t test of this size finds a difference of ln E; 0 of one session.
double power_of(const Experiment& experiment, int sessions, double difference, double size = 0.05);
/// Fewest sessions with this power, 0 if more than `most` are needed.
int sessions_for(const Experiment& experiment, double difference, double power, int most = 100);

}  // namespace rheocyte

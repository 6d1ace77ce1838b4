#include "population/power.h"

#include <cmath>

#include "population/statistics_laws.h"

namespace rheocyte {

double error_of_difference(const Experiment& e, int sessions) {
  const double of_cells = (e.spread * e.spread + e.image_error * e.image_error) / e.cells;
  return std::sqrt(2 * (e.between_recordings * e.between_recordings + of_cells) / sessions);
}

double power_of(const Experiment& experiment, int sessions, double difference, double size) {
  if (sessions < 2) return 0;
  const double freedom = sessions - 1, limit = students_t_quantile(freedom, 1 - size / 2);
  const double shift = std::abs(difference) / error_of_difference(experiment, sessions);
  // Beyond this the series of the noncentral law ends; there is no doubt there.
  constexpr double certain = 35;
  if (shift > certain) return 1;
  return shifted_t_beyond(freedom, shift, limit);
}

int sessions_for(const Experiment& experiment, double difference, double power, int most) {
  for (int sessions = 2; sessions <= most; ++sessions)
    if (power_of(experiment, sessions, difference) >= power) return sessions;
  return 0;
}

}  // namespace rheocyte

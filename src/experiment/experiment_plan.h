// Which channel, flow rate and medium show a difference between populations, and how many cells and sessions it takes
// (docs/theory-populations.md, sec. "Plan").
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "case/channel_flow.h"
#include "case/key.h"
#include "experiment/plan_options.h"
#include "measurement/viscosity.h"
#include "population/power.h"

namespace rheocyte {

/// Of the median cell, and of the cells that the table has, in a recommended channel.
inline constexpr Range recommended_deformation{0.01, 0.03};
inline constexpr double recommended_inside = 0.95;
/// Standard error of ln E by an image whose asymmetry is as great as its noise.
inline constexpr double error_of_noisy_image = 1;

/// One way to measure.
struct PlannedChannel {
  std::string medium;
  ChannelFlow flow;
  double speed_m_s = 0, wall_stress_Pa = 0;  ///< mean speed; shear stress at the wall without a cell
  double reynolds_number = 0;                ///< of which the tables hold nothing
  double deformation = 0, mode_3 = 0;        ///< of the median cell; NaN where the table does not have it
  double inside = 0;                         ///< fraction of the cells that the table has
  double error_by_asymmetry = 0, error_by_deformation = 0;  ///< of ln E by one image
  bool is_recommended = false;  ///< d of 0.01 to 0.03, 95 % of the cells inside, hardly any inertia
  int sessions = 0;             ///< for the wanted power, 0 if a hundred do not do
  /// Whether the table has the median cell and its asymmetry is above the noise of one image.
  bool shows_the_cells() const;
};

struct ExperimentPlan {
  std::vector<PlannedChannel> channels;
  /// Least error by the asymmetry among the recommended ones, else the one that is nearest to these.
  std::optional<std::size_t> best;
  /// With the best one: power of 2 .. 10 sessions.
  std::vector<double> power;
};

/// UserError if the tables are missing, the difference is 0, or no channel shows the cells.
ExperimentPlan plan_experiment(const PlanOptions& options);

/// With which the sessions are counted.
Experiment experiment_of(const PlanOptions& options, const PlannedChannel& channel);

}  // namespace rheocyte

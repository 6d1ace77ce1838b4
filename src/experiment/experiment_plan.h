// Which channel, flow rate and medium show a difference between populations, and how many cells and sessions it takes
// (docs/theory-populations.md, sec. "Plan").
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "case/channel_flow.h"
#include "measurement/viscosity.h"
#include "population/power.h"

namespace rheocyte {

struct PlanOptions {
  double radius_um = 0, young_modulus_kPa = 0;         ///< of the median cell
  double spread = 0.2, radius_spread = 0.07;           ///< standard deviations of ln E and ln r0 between cells
  double between_recordings = 0.03, difference = 0.1;  ///< scatter of ln E, and relative difference of E
  double power = 0.8, cells = 500;                     ///< wanted; cells of a recording
  double mode_2 = 0.1;                                 ///< how elongated the cells are
  double pixel_size_um = 0.34, temperature_C = 23;
  std::vector<double> widths_um{15, 20, 30};
  std::vector<std::string> media{"0.49% MC-PBS", "0.83% MC-PBS"};
  std::vector<double> rates_ul_s{};  ///< empty: those of mean speeds of 0.04, 0.1, 0.2 and 0.4 m/s
};

/// UserError naming an option that makes no sense.
void check_options(const PlanOptions& options);

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
  std::vector<std::string> lines;  ///< what follows, in sentences
};

/// UserError if the tables are missing or no channel shows the cells.
ExperimentPlan plan_experiment(const PlanOptions& options);

/// A line for each channel, with a line of names.
std::string plan_table(const ExperimentPlan& plan);
inline constexpr std::string_view mark_of_plan = "width_um\tmedium\trate_ul_per_s\t";

}  // namespace rheocyte

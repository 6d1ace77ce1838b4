// What one panel of the picture of events needs from a recording.
#pragma once
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <tuple>
#include <vector>

#include "infer/modulus_map.h"
#include "measurement/recording.h"
#include "report/plot_options.h"
#include "store/progress.h"

namespace rheocyte {

struct PlotPanel {
  std::size_t events = 0;       ///< rows of the recording
  std::size_t gated = 0;        ///< of these, outside the gates
  std::size_t drawable = 0;     ///< of the others, with numbers on both axes
  bool has_conditions = false;  ///< false if no lines are requested, or for a recording of the reservoir
  /// Pixel size 0: nothing is added to the lines. The viscosity is that at the median temperature.
  MeasuringConditions conditions;
  double width_um = 0;           ///< of the channel, 0 if unknown
  std::string sample, measured;  ///< the metadata's name of the sample; channel, flow, viscosity in one line
  std::string recommended;       ///< recommended_in_short; empty where no lines are requested
  std::vector<std::string> warnings;

  /// For store/bytes.h.
  template <class Self>
  static auto fields(Self& p) {
    return std::tie(p.events, p.gated, p.drawable, p.has_conditions, p.conditions, p.width_um, p.sample, p.measured,
                    p.recommended, p.warnings);
  }
};

/// Isoelasticity lines; if possible: with a warning where the recording does not say how it was measured.
enum class LinesWanted { no, if_possible, yes };

/// Takes the drawable events of a block: the two numbers of each in turn.
using TakePairs = std::function<void(std::span<const float> pairs)>;

/// Whether the cells are not in the channel, where no isoelasticity lines exist.
bool is_of_the_reservoir(const Recording& recording);

/// Conditions, what is said of them, and warnings. UserError naming what the recording lacks.
void take_conditions(const Recording& recording, const PlotOptions& options, PlotPanel& panel);

/// Reads a recording block by block and hands on what stands on the two axes, usually area (um^2) and deformation, of
/// each drawable event. The conditions of the measurement are found, too, where lines are requested. UserError.
PlotPanel plot_panel(const std::filesystem::path& recording, const PlotOptions& options, LinesWanted lines,
                     const TakePairs& take_pairs, const TellProgress& on_progress);

}  // namespace rheocyte

// Whether recordings of one set-up have one axial tension of the liquid: it belongs to the medium, the channel and the
// flow, not to the cells (docs/real-cells.md).
#pragma once
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "experiment/recording_report.h"

namespace rheocyte {

/// The mean of ln of the axial tension over the wall shear stress of the recordings that were measured as this one and
/// have a tension, and the standard deviation between them; nothing if they are fewer than two.
struct SharedTension {
  double log_over_wall_stress, deviation;
};
std::optional<SharedTension> tension_of_setup(std::span<const RecordingReport> recordings,
                                              const RecordingReport& recording);

/// Of each set-up of at least three recordings that have a tension: whether it is one, in all recordings and for cells
/// of all sizes; and whether set-ups have it in proportion to the wall shear stress.
std::vector<std::string> tensions_of_setups(const std::vector<RecordingReport>& recordings);

}  // namespace rheocyte

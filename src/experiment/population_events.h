// The events of one recording as populations are fitted to: all that is measured of each cell.
#pragma once
#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "events/options.h"
#include "events/recording_facts.h"
#include "infer/solid_maps.h"
#include "shape/outline_shape.h"
#include "store/progress.h"

namespace rheocyte {

/// What is measured of each event.
enum class SeenMeasure {
  area_um2,
  deformation,
  inertia_ratio,
  mode_2,
  mode_3,
  mode_4,
  mode_5,
  mode_6,
  mode_7,
  viscosity_mPas
};
inline constexpr int seen_measures = int(SeenMeasure::viscosity_mPas) + 1;

struct PopulationEvents : RecordingFacts {
  bool has_outlines = false, has_inertia_ratios = true;
  std::size_t without_numbers = 0;
  /// Limits of the gates on area and deformation; those that are not part of the model in words.
  double least_area_um2 = 0, greatest_area_um2 = 0, least_deformation = 0, greatest_deformation = 0;
  std::string gates_beside_the_model;
  std::vector<double> number;                                ///< of each event in the recording, from 1 on
  std::array<std::vector<double>, seen_measures> seen = {};  ///< 0: those that the recording does not have
  std::vector<std::string> warnings;                         ///< with the remarks on the recording

  std::size_t events() const { return number.size(); }
  const ChannelFlow& flow() const { return conditions.flow; }  ///< its viscosity does not count
  /// Of at least one event; what is not measured is 0.
  ShapeVector median_shape() const;
  const std::vector<double>& of(SeenMeasure m) const { return seen[std::size_t(m)]; }
  /// Whether the recording has it.
  bool has(SeenMeasure m) const {
    if (m == SeenMeasure::inertia_ratio) return has_inertia_ratios;
    return has_outlines || m < SeenMeasure::mode_2 || m > SeenMeasure::mode_7;
  }

  /// For store/bytes.h.
  template <class Self>
  static auto fields(Self& s) {
    return std::tuple_cat(
        RecordingFacts::fields(s),
        std::tie(s.has_outlines, s.has_inertia_ratios, s.without_numbers, s.least_area_um2, s.greatest_area_um2,
                 s.least_deformation, s.greatest_deformation, s.gates_beside_the_model, s.number, s.seen[0], s.seen[1],
                 s.seen[2], s.seen[3], s.seen[4], s.seen[5], s.seen[6], s.seen[7], s.seen[8], s.seen[9], s.warnings));
  }
};

/// Of those events inside the gates of which everything is a number. UserError for what is wrong with the recording:
/// the asymmetry needs contours or masks, the odd part of the deformation these or inertia ratios. Without a measure
/// whatever the recording has.
PopulationEvents read_population_events(const std::filesystem::path& recording, const MeasuringOptions& options,
                                        const std::optional<StiffnessMeasure>& by, const TellProgress& report_progress);

}  // namespace rheocyte

#include "experiment/recording_report.h"

#include <algorithm>
#include <array>

namespace rheocyte {

QuantityWords words_of(PopulationQuantity quantity) {
  constexpr std::array<QuantityWords, std::size_t(PopulationQuantity::count)> words{{
      {"young_modulus", "kPa", "E", "kPa"},
      {"stiffness", "kPa", "E + E2D/r0", "kPa"},
      {"effective_modulus", "kPa", "E_eff", "kPa"},
      {"cortex_modulus", "mN_per_m", "E2D", "mN/m"},
      {"cortex_tension", "mN_per_m", "tension", "mN/m"},
      {"axial_tension", "Pa", "axial tension", "Pa"},
  }};
  return words[std::size_t(quantity)];
}

const QuantityEstimate* RecordingReport::estimate(PopulationQuantity quantity) const {
  const auto found = std::ranges::find(quantities, quantity, &QuantityEstimate::quantity);
  return failure.empty() && found != quantities.end() ? &*found : nullptr;
}

double RecordingReport::wall_stress_Pa() const {
  ChannelFlow at_median = conditions.flow;
  at_median.viscosity_mPas = median_viscosity_mPas;
  return wall_shear_stress_Pa(at_median);
}

}  // namespace rheocyte

#include "report/former_names.h"

#include <algorithm>
#include <array>

namespace rheocyte {

std::span<const FormerName> former_names() {
  static constexpr std::array<FormerName, 29> names{{
      // of summaries
      {"recommended_young_modulus_median_error_kPa", "recommended_young_modulus_median_kPa_error"},
      {"recommended_young_modulus_common_error_kPa", "recommended_young_modulus_median_kPa_common_error"},
      {"young_modulus_median_error_kPa", "young_modulus_median_kPa_error"},
      {"young_modulus_common_error_kPa", "young_modulus_median_kPa_common_error"},
      {"young_modulus_standard_error_median_kPa", "young_modulus_kPa_error_median"},
      {"young_modulus_elongated_median_error_kPa", "young_modulus_elongated_median_kPa_error"},
      {"elongation_common_error", "elongation_median_common_error"},
      {"axial_tension_median_error_Pa", "axial_tension_median_Pa_error"},
      {"axial_tension_common_error_Pa", "axial_tension_median_Pa_common_error"},
      {"flank_slope_per_um_change", "flank_slope_change_per_um"},
      {"flank_slope_per_um_stored", "flank_slope_stored_per_um"},
      {"mean_viscosity_mPas", "viscosity_mean_mPas"},
      {"flow_rate_ul_s", "flow_rate_ul_per_s"},
      // of events
      {"standard_error_kPa", "young_modulus_kPa_error"},
      {"standard_error_asymmetry_kPa", "young_modulus_asymmetry_kPa_error"},
      {"standard_error_inertia_kPa", "young_modulus_inertia_kPa_error"},
      {"axial_tension_error_Pa", "axial_tension_Pa_error"},
      {"young_modulus_error_kPa", "young_modulus_kPa_error"},
      {"cortex_modulus_error_mN_per_m", "cortex_modulus_mN_per_m_error"},
      {"tension_error_mN_per_m", "tension_mN_per_m_error"},
      {"stiffness_error_kPa", "stiffness_kPa_error"},
      // roles in companions
      {"standard error", "young_modulus_kPa_error"},
      {"young_modulus_asymmetry", "young_modulus_asymmetry_kPa"},
      {"young_modulus_inertia", "young_modulus_inertia_kPa"},
      {"standard error asymmetry", "young_modulus_asymmetry_kPa_error"},
      {"standard error inertia", "young_modulus_inertia_kPa_error"},
      {"axial_tension", "axial_tension_Pa"},
      {"elongation error", "elongation_error"},
      {"axial tension error", "axial_tension_Pa_error"},
  }};
  return names;
}

std::string_view present_name(std::string_view name) {
  const auto all = former_names();
  const auto found = std::ranges::find(all, name, &FormerName::former);
  return found == all.end() ? name : found->present;
}

}  // namespace rheocyte

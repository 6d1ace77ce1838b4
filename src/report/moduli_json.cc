#include "report/moduli_json.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "store/build_info.h"

namespace rheocyte {

namespace {

using nlohmann::ordered_json;

ordered_json counts_of(const ModuliSummary& s) {
  ordered_json counts;
  for (int k = 0; k < moduli_status_count; ++k)
    counts[std::string(name_of(ModuliStatus(k)))] = s.counts[std::size_t(k)];
  return counts;
}

ordered_json quartiles_of(const Distribution& d, std::size_t events) {
  if (events == 0) return nullptr;
  return {{"first_quartile", d.first_quartile},
          {"median", d.median},
          {"median_error", d.median_error},
          {"third_quartile", d.third_quartile}};
}

/// The 90 % interval is that of the common tension.
ordered_json tension_of(const AxialSummary& s) {
  if (!s.is_of_elongated_cells) return nullptr;
  return {{"value_Pa", s.common.value_Pa},
          {"lower_Pa", s.common.lower_Pa},
          {"upper_Pa", s.common.upper_Pa},
          {"is_given", s.is_given},
          {"cells", s.common.cells},
          {"chi_squared_per_freedom", s.common.misfit},
          {"wall_shear_stress_Pa", s.wall_stress_Pa}};
}

ordered_json slopes_of(const AxialSummary& s) {
  ordered_json slopes = ordered_json::array();
  if (!s.is_of_elongated_cells || std::isnan(s.measured.value[0])) return slopes;
  for (std::size_t k = 0; k < slope_count; ++k)
    slopes.push_back({{"name", fmt::format("dc{}/dc2", k + 3)},
                      {"value", s.measured.value[k]},
                      {"error", s.measured.error[k]},
                      {"by_stiffness", s.predicted.by_stiffness[k]},
                      {"by_cortex_fraction", s.predicted.by_fraction[k]},
                      {"by_tension_ratio", s.predicted.by_ratio[k]},
                      {"by_axial_tension", s.predicted.by_axial_tension[k]}});
  return slopes;
}

ordered_json features_of_median(const MedianCell& m) {
  ordered_json features = ordered_json::array();
  const auto add = [&](std::string name, double measured, double error, double fitted) {
    features.push_back({{"name", std::move(name)}, {"measured", measured}, {"error", error}, {"fitted", fitted}});
  };
  const double area = std::exp(m.measured[0]);
  add("area_um2", area, area * m.error[0], std::exp(m.fitted[0]));
  add("deformation", m.measured[1], m.error[1], m.fitted[1]);
  for (int k = min_mode; k <= max_mode; ++k) {
    const auto f = std::size_t(int(ShapeFeature::first_mode) + k - min_mode);
    add(fmt::format("c{}", k), m.measured[f], m.error[f], m.fitted[f]);
  }
  return features;
}

ordered_json median_cell_of(const MedianCell& m) {
  if (m.cells < MedianCell::min_cells || m.status == ModuliStatus::no_data) return nullptr;
  return {{"cells", m.cells},
          {"status", name_of(m.status)},
          {"young_modulus_kPa", m.young_kPa},
          {"young_modulus_error_kPa", m.young_error_kPa},
          {"cortex_modulus_mN_per_m", m.cortex_mN_per_m},
          {"cortex_modulus_error_mN_per_m", m.cortex_error_mN_per_m},
          {"tension_mN_per_m", m.tension_mN_per_m},
          {"tension_error_mN_per_m", m.tension_error_mN_per_m},
          {"stiffness_kPa", m.stiffness_kPa},
          {"stiffness_error_kPa", m.stiffness_error_kPa},
          {"axial_tension_Pa", m.axial_tension_Pa},
          {"axial_tension_error_Pa", m.axial_tension_error_Pa},
          {"chi_squared", m.chi_squared},
          {"degrees_of_freedom", m.freedom},
          {"at_end_of_table", m.is_at_end},
          {"features", features_of_median(m)}};
}

}  // namespace

std::string moduli_json(const std::filesystem::path& recording, const std::string& table, const ModuliSummary& s) {
  const ordered_json content{{"made_by", "rheocyte moduli"},
                             {"version", version},
                             {"recording", recording.string()},
                             {"table", table},
                             {"outline_noise_um", s.outline_noise_um},
                             {"gates", s.gates},
                             {"events", counts_of(s)},
                             {"young_modulus_kPa", quartiles_of(s.young_kPa, s.resolved())},
                             {"cortex_modulus_mN_per_m", quartiles_of(s.cortex_mN_per_m, s.resolved())},
                             {"stiffness_kPa", quartiles_of(s.stiffness_kPa, s.with_stiffness())},
                             {"axial_tension", tension_of(s.axial)},
                             {"slopes_between_cells", slopes_of(s.axial)},
                             {"median_cell", median_cell_of(s.median_cell)},
                             {"warnings", s.warnings}};
  return content.dump(2, ' ', false, ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace rheocyte

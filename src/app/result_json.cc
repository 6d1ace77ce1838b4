#include <cmath>
#include <nlohmann/json.hpp>
#include <thread>

#include "app/result.h"
#include "case/scales.h"
#include "case/write_case.h"
#include "store/build_info.h"

namespace rheocyte {

namespace {

using Json = nlohmann::ordered_json;

constexpr double um_per_m = 1e6;

#ifdef __clang__
constexpr const char* compiler = "Clang " __clang_version__;
#else
constexpr const char* compiler = "GCC " __VERSION__;
#endif

// What decides about the last bits of a result.
Json build_and_threads() {
  return {{"compiler", compiler}, {"threads", {{"processors", std::thread::hardware_concurrency()}}}};
}

Json statistics(const SolveStatistics& s) {
  return {{"degree", s.degree},
          {"elements", s.elements},
          {"factorisations", s.factorisations},
          {"continuation_steps", s.continuation_steps},
          {"assembly_s", s.assembly_s},
          {"factorisation_s", s.factorisation_s},
          {"substitution_s", s.substitution_s},
          {"total_s", s.total_s}};
}

// A modulus on the way to the wanted one; null if there is none or the cell is rigid.
Json over(const std::optional<double>& modulus, double compliance) {
  return modulus && compliance > 0 ? Json(*modulus / compliance) : Json(nullptr);
}

Json branch(const Result& result) {
  Json points = Json::array();
  for (const auto& point : result.state.branch)
    points.push_back({{"compliance", point.compliance},  // relative to the wanted one; 0 = rigid: modulus null
                      {"young_modulus_kPa", over(result.input.cell.bulk.young_modulus_kPa, point.compliance)},
                      {"cortex_modulus_mN_per_m", over(result.input.cell.cortex.modulus_mN_per_m, point.compliance)},
                      {"deformation", point.deformation},
                      {"newton_iterations", point.newton_iterations},
                      {"degree", point.degree}});
  return points;
}

void add_shape(Json& json, const Result& result) {
  const auto& shape = result.state.shape;
  const double R = result.scales.length_m * um_per_m;
  json["deformation"] = shape.deformation;
  json["deformation_raw"] = shape.deformation_raw;
  json["area_um2"] = shape.area * R * R;
  json["area_raw_um2"] = shape.area_raw * R * R;
  json["perimeter_um"] = shape.perimeter * R;
  json["perimeter_raw_um"] = shape.perimeter_raw * R;
  json["volume_um3"] = shape.volume * R * R * R;
  json["relative_volume_change"] = result.state.relative_volume_change;
  json["moment_ratio"] = shape.moment_ratio;
  json["moment_ratio_raw"] = shape.moment_ratio_raw;
  json["inertia_ratio"] = shape.inertia_ratio;
  json["least_meridional_stretch"] = result.state.least_meridional_stretch;
  json["biot_ratio"] = result.state.biot_ratio;
  json["stability_margin"] = result.state.stability_margin;
  json["least_tension_mN_per_m"] = result.state.least_tension * result.scales.stress_Pa * result.scales.length_m * 1e3;
}

void add_flow(Json& json, const Result& result) {
  const auto& state = result.state;
  const auto& scales = result.scales;
  json["cell_velocity_m_per_s"] = state.cell_velocity * scales.velocity_m_per_s;
  json["mean_velocity_m_per_s"] = scales.velocity_m_per_s * state.flow_rate;
  json["flow_rate_ul_per_s"] = unit_rate_ul_per_s(scales) * state.flow_rate;
  json["pressure_drop_Pa"] = state.pressure_drop * scales.stress_Pa;
  json["additional_pressure_drop_Pa"] = state.additional_pressure_drop * scales.stress_Pa;
  json["inner_pressure_Pa"] = state.inner_pressure * scales.stress_Pa;  // null: the interior is elastic
  json["simulated_length_um"] = state.channel_length * scales.length_m * um_per_m;
  json["tube_radius_um"] = tube_radius_um(result.input);
  // rho v_cell R / eta, with the viscosity of the liquid at the shear rate U/R
  json["reynolds"] = result.problem.liquid.reynolds * state.cell_velocity;
}

}  // namespace

void refuse_unfinite_numbers(StationaryState& state) {
  if (state.outcome.status != Status::converged) return;
  const auto& s = state.shape;
  for (const double number :
       {s.deformation, s.deformation_raw, s.area, s.area_raw, s.perimeter, s.perimeter_raw, s.volume, s.moment_ratio,
        s.inertia_ratio, state.cell_velocity, state.pressure_drop, state.additional_pressure_drop,
        state.relative_volume_change, state.least_meridional_stretch, state.residual, state.estimated_error})
    if (!std::isfinite(number)) {
      state.outcome.status = Status::not_finite;
      state.outcome.message = "The computation ended with a number that is not finite; please report the case.";
    }
}

// nlohmann::json writes null for a number that is not finite.
Json to_json(const Result& result) {
  const auto& state = result.state;
  Json json;
  json["program"] = "rheocyte";
  json["version"] = version;
  json["status"] = name(state.outcome.status);
  json["message"] = state.outcome.message;
  json["reached"] = state.outcome.reached;
  json["young_modulus_reached_kPa"] = over(result.input.cell.bulk.young_modulus_kPa, state.outcome.reached);
  json["cortex_modulus_reached_mN_per_m"] = over(result.input.cell.cortex.modulus_mN_per_m, state.outcome.reached);
  json["tension_mN_per_m"] = tension_mN_per_m(result.input);
  add_shape(json, result);
  add_flow(json, result);
  json["unknowns"] = state.statistics.unknowns;
  json["newton_iterations"] = state.statistics.newton_iterations;
  json["residual"] = state.residual;
  json["estimated_error"] = state.estimated_error;
  json["wall_time_s"] = state.statistics.total_s;
  json["case"] = to_json(result.input);
  json["case_hash"] = case_hash(result.input);
  json["branch"] = branch(result);
  json["statistics"] = statistics(state.statistics);
  json.update(build_and_threads());
  return json;
}

}  // namespace rheocyte

#include "app/analytic_cell.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "case/json_guard.h"
#include "case/scales.h"
#include "case/user_error.h"
#include "store/build_info.h"

namespace rheocyte {

namespace {

using std::numbers::pi;

constexpr double mN_per_N = 1e3;
constexpr int contour_points = 721;

std::string line(std::string_view name, const std::string& value, const std::string& note = "") {
  return note.empty() ? fmt::format("  {:<24} {}\n", name, value)
                      : fmt::format("  {:<24} {:<16} {}\n", name, value, note);
}

// In units of the mean speed, and eta u_max / R in units of the stress scale.
double peak_to_mean_velocity(const AnalyticCell& cell) { return pi * peak_velocity(cell.input.conditions.duct()); }

double velocity_m_per_s(const AnalyticCell& cell) {
  return cell.cell.sphere.velocity * peak_to_mean_velocity(cell) * cell.scales.velocity_m_per_s;
}

double additional_pressure_drop_Pa(const AnalyticCell& cell) {
  return cell.cell.sphere.pressure_drop * peak_to_mean_velocity(cell) * cell.scales.stress_Pa;
}

}  // namespace

std::string AnalyticCell::remark() const {
  const double greatest = is_solid() ? max_solid_deformation : max_shell_deformation;
  if (state.shape.deformation <= greatest && cell.sphere.lambda <= max_ratio_of_agreement) return {};
  return fmt::format(
      "beyond the range of the model (d up to {}, r0 up to {} tube radii), where errors exceed 10 %; see `rheocyte "
      "solve`",
      greatest, max_ratio_of_agreement);
}

AnalyticCell analytic_cell(const AnalyticCellInput& input) {
  AnalyticCell cell{.input = input, .scales = scales_of(input.conditions.input), .cell = {}, .state = {}};
  const Duct duct = input.conditions.duct();
  const double lambda = checked_radius_ratio(input.conditions, input.radius_um, "--radius-um");
  if (cell.is_solid()) {
    cell.capillary_number = elastic_scale_kPa(input.conditions) / *input.young_modulus_kPa;
    cell.cell = solid_in_tube(lambda);
    cell.strain = solid_strain(cell.capillary_number, duct);
  } else {
    const double scale_mN_per_m = pi * cell.scales.stress_Pa * cell.scales.length_m * mN_per_N;
    cell.capillary_number = scale_mN_per_m / input.cortex_modulus_mN_per_m.value();
    cell.cell = shell_in_tube(lambda, input.tension_ratio);
    cell.strain = shell_strain(cell.capillary_number, lambda, duct);
  }
  cell.state = small_deformation(cell.cell, cell.strain);
  if (!std::isfinite(cell.state.shape.deformation))
    throw UserError(
        fmt::format("rheocyte: the cell is far too soft for a model of small deformations (capillary number {:.3g}); "
                    "raise its modulus, or use `rheocyte solve`.",
                    cell.capillary_number));
  return cell;
}

std::string summary(const AnalyticCell& cell) {
  const auto& shape = cell.state.shape;
  const double R = cell.scales.length_um();
  const auto stiffness = cell.is_solid() ? fmt::format("solid, E = {:g} kPa", *cell.input.young_modulus_kPa)
                                         : fmt::format("shell, E2D = {:g} mN/m, tension {:g} E2D",
                                                       *cell.input.cortex_modulus_mN_per_m, cell.input.tension_ratio);
  std::string text = fmt::format("rheocyte {}: analytical model of small deformations\n", version);
  text += line("cell", stiffness);
  text += line("radius", fmt::format("{:g} um", cell.input.radius_um),
               fmt::format("{:.6g} of the tube radius {:g} um", cell.cell.sphere.lambda, R));
  text += line("deformation", fmt::format("{:.6g}", shape.deformation),
               fmt::format("raw {:.6g}, leading order {:.6g}", shape.deformation_raw,
                           leading_deformation(cell.cell) * cell.strain * cell.strain));
  text +=
      line("area", fmt::format("{:.3f} um^2", shape.area * R * R), fmt::format("raw {:.3f}", shape.area_raw * R * R));
  text += line("volume", fmt::format("{:.3f} um^3", shape.volume * R * R * R));
  text += line("cell velocity", fmt::format("{:.5g} m/s", velocity_m_per_s(cell)),
               fmt::format("{:.6g} of the velocity on the axis", cell.cell.sphere.velocity));
  text += line("additional pressure drop", fmt::format("{:.5g} Pa", additional_pressure_drop_Pa(cell)));
  text += line("capillary number", fmt::format("{:.5g}", cell.capillary_number));
  if (const auto remark = cell.remark(); !remark.empty()) text += line("remark", remark);
  return text;
}

nlohmann::ordered_json to_json(const AnalyticCell& cell) {
  const auto& shape = cell.state.shape;
  const double R = cell.scales.length_um();
  nlohmann::ordered_json json;
  json["program"] = "rheocyte";
  json["version"] = version;
  json["model"] = cell.is_solid() ? "analytical solid" : "analytical shell";
  json["deformation"] = shape.deformation;
  json["deformation_raw"] = shape.deformation_raw;
  json["leading_deformation"] = leading_deformation(cell.cell) * cell.strain * cell.strain;
  json["area_um2"] = shape.area * R * R;
  json["area_raw_um2"] = shape.area_raw * R * R;
  json["perimeter_um"] = shape.perimeter * R;
  json["volume_um3"] = shape.volume * R * R * R;
  json["moment_ratio"] = shape.moment_ratio;
  json["inertia_ratio"] = shape.inertia_ratio;
  json["cell_velocity_m_per_s"] = velocity_m_per_s(cell);
  json["additional_pressure_drop_Pa"] = additional_pressure_drop_Pa(cell);
  json["tube_radius_um"] = R;
  json["radius_um"] = cell.input.radius_um;
  json["capillary_number"] = cell.capillary_number;
  if (cell.is_solid()) json["young_modulus_kPa"] = *cell.input.young_modulus_kPa;
  if (!cell.is_solid()) {
    json["cortex_modulus_mN_per_m"] = *cell.input.cortex_modulus_mN_per_m;
    json["tension_ratio"] = cell.input.tension_ratio;
  }
  json["duct"] = cell.input.conditions.square_duct ? "square" : "tube";
  json["within_limits"] = cell.remark().empty();
  json["remark"] = cell.remark();
  return json;
}

Eigen::MatrixX2d contour_um(const AnalyticCell& cell) {
  Eigen::MatrixX2d points = cell.scales.length_um() *
                            surface_points(cell.cell, cell.strain, Eigen::ArrayXd::LinSpaced(contour_points, 0, pi));
  points(0, 1) = points(contour_points - 1, 1) = 0;  // sin(pi) is not zero in floating point
  return points;
}

std::string contour_text(const AnalyticCell& cell) {
  const Eigen::MatrixX2d points = contour_um(cell);
  std::string text(contour_mark);
  for (Eigen::Index i = 0; i < points.rows(); ++i) text += fmt::format("{:.10g},{:.10g}\n", points(i, 0), points(i, 1));
  return text;
}

}  // namespace rheocyte

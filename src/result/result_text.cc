#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "case/scales.h"
#include "result/plural.h"
#include "result/result.h"
#include "store/build_info.h"

namespace rheocyte {

namespace {

std::string line(std::string_view name, const std::string& value, const std::string& remark) {
  return fmt::format("  {:<18} {:<25} {}\n", name, value, remark);
}

/// "0.0123 +- 2e-07": a number, and its error if that is known.
std::string with_error(const std::string& number, double error) {
  return std::isfinite(error) ? fmt::format("{} +- {:.1g}", number, error) : number;
}

/// With this many decimals, or, where these would hide the number, with three digits.
std::string with_decimals(double number, int decimals) {
  const bool is_hidden = number != 0 && std::abs(number) < std::pow(10, 2 - decimals);
  return is_hidden ? fmt::format("{:.3g}", number) : fmt::format("{:.{}f}", number, decimals);
}

std::string seen_from(const Channel& channel) {
  if (channel.camera_degree) return fmt::format("seen at {:g} degrees", *channel.camera_degree);
  if (channel.section == Section::rectangle) return "seen along the height";
  return channel.camera == View::diagonal ? "seen along the diagonal" : "seen from the side";
}

/// Which channel was computed: a width means a square one, for which a tube may stand.
std::string channel_line(const Case& input) {
  const Channel& channel = input.channel;
  if (!channel.profile.width_um.empty() && is_duct(channel.section))
    return line("channel", fmt::format("funnel to {:.5g} um", least_width_um(channel)), seen_from(channel));
  if (!channel.width_um) return "";
  if (channel.section == Section::rectangle)
    return line("channel", fmt::format("{:.5g} x {:.5g} um", *channel.width_um, *channel.height_um),
                seen_from(channel));
  if (channel.section == Section::square)
    return line("channel", fmt::format("{:.5g} um square", *channel.width_um), seen_from(channel));
  return line("channel", fmt::format("{:.5g} um tube", 2 * tube_radius_um(input)),
              fmt::format("for the square of {:.5g} um, which channel.section = \"square\" computes itself",
                          *channel.width_um));
}

/// The main numbers with their errors.
std::string measures_text(const Result& result) {
  const StationaryState& state = result.state;
  const ShapeMeasures& shape = state.shape;
  const StateNumbers& errors = state.errors;
  const auto& scales = result.scales;
  const double R = scales.length_um(), U = scales.velocity_m_per_s, S = scales.stress_Pa;
  const auto deformation = [](double d, double error) { return with_error(with_decimals(d, 6), error); };
  std::string text = line("deformation", deformation(shape.deformation, errors.shape.deformation),
                          "raw " + deformation(shape.deformation_raw, errors.shape.deformation_raw));
  const auto area = [&](double a, double error) { return with_error(fmt::format("{:.3f}", a * R * R), error * R * R); };
  text +=
      line("area", area(shape.area, errors.shape.area) + " um^2", "raw " + area(shape.area_raw, errors.shape.area_raw));
  if (std::isfinite(state.deformation_side))
    text += line("by view", deformation(state.deformation_side, errors.deformation_side) + " side",
                 std::isfinite(state.deformation_diagonal)
                     ? deformation(state.deformation_diagonal, errors.deformation_diagonal) + " diagonal"
                     : deformation(state.deformation_across, errors.deformation_across) + " along the width");
  text += line("cell velocity",
               with_error(fmt::format("{:.5g}", state.cell_velocity * U), errors.cell_velocity * U) + " m/s",
               fmt::format("mean velocity of the liquid {:.5g}", U));
  if (std::isfinite(state.offset))
    text +=
        line("off the axis", fmt::format("{:.4g} um", state.offset * R),
             std::isfinite(state.offset_error)
                 ? fmt::format("+- {:.2g}, where it does not drift", state.offset_error * R)
                 : "drift " + with_error(fmt::format("{:.3g}", state.drift_velocity * U), errors.drift_velocity * U) +
                       " m/s");
  text += line(
      "pressure drop", with_error(fmt::format("{:.5g}", state.pressure_drop * S), errors.pressure_drop * S) + " Pa",
      std::isfinite(state.additional_pressure_drop)
          ? with_error(fmt::format("{:.4g}", state.additional_pressure_drop * S), errors.additional_pressure_drop * S) +
                " due to the cell"
          : "");
  return text;
}

/// Of a cell with a cortex; of a solid it is its own modulus.
std::string effective_modulus_line(const Result& result) {
  const Cortex& cortex = result.problem.cortex;
  const double modulus_kPa = effective_modulus_kPa(result);
  const bool is_solid = cortex.law == CortexLaw::none && cortex.tension == 0 && cortex.bending == 0;
  if (is_solid || !std::isfinite(modulus_kPa)) return "";
  return line("effective modulus", fmt::format("{:.4g} kPa", modulus_kPa),
              "of a solid that a small tension elongates as much");
}

/// What the estimated error is relative to, and which one is requested.
std::string error_remark(const Result& result) {
  const Case& input = result.input;
  const bool in_time = input.time.scheme != TimeScheme::stationary;
  const std::optional<double> wanted = in_time ? input.time.mesh_accuracy : input.numerics.accuracy;
  std::string remark = "of the deformation";
  if (input.numerics.accuracy_of == AccuracyOf::motion && result.state.offset != 0)
    remark = "of velocity, drift and rotation";
  else if (result.state.shape.deformation < result.state.deformation_floor)
    remark = fmt::format("of a deformation of {:.1e}", result.state.deformation_floor);
  return wanted ? fmt::format("{}, requested {:.1e}", remark, *wanted) : remark;
}

}  // namespace

std::span<const Field<ProfilePoint>> contour_fields() {
  using P = ProfilePoint;
  static constexpr Field<P> fields[] = {
      {"x_um", "along the channel, 0 at the cell's barycentre", [](const P& p) { return p.surface.point(p.row, 0); }},
      {"r_um", "distance from the axis", [](const P& p) { return std::max(p.surface.point(p.row, 1), 0.0); }},
      {"rest_angle_degree", "where the point was on the sphere at rest, from the flow direction",
       [](const P& p) { return p.surface.rest_angle(p.row); }},
      {"stretch_meridional", "stretch of the surface along the meridian",
       [](const P& p) { return p.surface.stretch(p.row, 0); }},
      {"stretch_hoop", "stretch round the axis, in a square channel across the meridian",
       [](const P& p) { return p.surface.stretch(p.row, 1); }},
      {"tension_meridional_mN_per_m", "Cauchy tension of the surface, surface tension included",
       [](const P& p) { return p.surface.tension(p.row, 0); }},
      {"tension_hoop_mN_per_m", "the same round the axis", [](const P& p) { return p.surface.tension(p.row, 1); }},
      {"curvature_meridional_per_um", "positive where the contour is convex",
       [](const P& p) { return p.surface.curvature(p.row, 0); }},
      {"curvature_hoop_per_um", "round the axis", [](const P& p) { return p.surface.curvature(p.row, 1); }}};
  return fields;
}

std::string contour_csv(const SurfaceProfile& surface, const Scales& scales) {
  std::string text;
  const auto add_row = [&](const auto& text_of) {
    std::string_view separator;
    for (const auto& field : contour_fields()) {
      text += fmt::format("{}{}", separator, text_of(field));
      separator = ",";
    }
    text += '\n';
  };
  add_row([](const auto& field) { return std::string(field.name); });
  for (const Eigen::Index i : surface.distinct_rows())
    add_row([&](const auto& field) {
      return fmt::format("{:.10g}", field.value({surface, i}) * dimensionless_one(unit_of(field.name), scales));
    });
  return text;
}

std::string offset_outline_csv(const Eigen::MatrixX2d& outline, const Scales& scales) {
  std::string text = "x_um,y_um\n";
  for (const auto& point : outline.rowwise())
    text += fmt::format("{:.10g},{:.10g}\n", point(0) * scales.length_um(), point(1) * scales.length_um());
  return text;
}

std::string summary(const Result& result, const std::string& folder) {
  const StationaryState& state = result.state;
  std::string text = fmt::format("rheocyte {}: {}\n", version, name(state.outcome.status));
  text += channel_line(result.input) + measures_text(result) + effective_modulus_line(result);
  if (const double reached = state.outcome.reached; reached > 0 && reached < 1) {
    const Cell& cell = result.input.cell;
    const auto modulus = [&](std::string_view name, const std::optional<double>& wanted, std::string_view unit) {
      if (!wanted) return;
      text += line(name, fmt::format("{:.5g} {}", *wanted / reached, unit), fmt::format("wanted {:.5g}", *wanted));
    };
    modulus("young modulus", cell.bulk.young_modulus_kPa, "kPa");
    modulus("cortex modulus", cell.cortex.modulus_mN_per_m, "mN/m");
  }
  const bool in_time = result.input.time.scheme != TimeScheme::stationary;
  if (std::isfinite(state.estimated_error))
    text += line("estimated error", fmt::format("{:.1e}", state.estimated_error), error_remark(result));
  else if (in_time && state.outcome.status == Status::converged)
    text += line("estimated error", "not known", "of the deformation");
  if (in_time && state.outcome.status == Status::converged) text += fmt::format("  {}\n", state.outcome.message);
  text += line("time", fmt::format("{:.2f} s", state.statistics.total_s),
               fmt::format("{}, {}, {} unknowns", plural(state.statistics.continuation_steps, "step"),
                           plural(state.statistics.newton_iterations, "Newton iteration"), state.statistics.unknowns));
  return text + fmt::format("  {:<18} {}\n", "folder", folder);
}

}  // namespace rheocyte

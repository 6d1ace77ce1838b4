#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>

#include "app/result.h"
#include "store/build_info.h"

namespace rheocyte {

namespace {

constexpr double um_per_m = 1e6;
constexpr double mN_per_N = 1e3;

std::string line(std::string_view name, const std::string& value, const std::string& remark) {
  return fmt::format("  {:<18} {:<16} {}\n", name, value, remark);
}

}  // namespace

std::string contour_csv(const Result& result) {
  const SurfaceProfile& surface = result.state.surface;
  const double um = result.scales.length_m * um_per_m;
  const double mN_per_m = result.scales.stress_Pa * result.scales.length_m * mN_per_N;
  const double degree = 180 / std::numbers::pi;
  std::string text =
      "x_um,r_um,rest_angle_degree,stretch_meridional,stretch_hoop,tension_meridional_mN_per_m,"
      "tension_hoop_mN_per_m,curvature_meridional_per_um,curvature_hoop_per_um\n";
  for (Eigen::Index i = 0; i < surface.point.rows(); ++i) {
    // The first point of a piece is the last one of the piece before.
    if (i > 0 && i % SurfaceProfile::points_per_piece == 0) continue;
    fmt::format_to(std::back_inserter(text), "{:.10g},{:.10g},{:.8g},{:.8g},{:.8g},{:.8g},{:.8g},{:.8g},{:.8g}\n",
                   um * surface.point(i, 0), std::max(um * surface.point(i, 1), 0.0), degree * surface.rest_angle(i),
                   surface.stretch(i, 0), surface.stretch(i, 1), mN_per_m * surface.tension(i, 0),
                   mN_per_m * surface.tension(i, 1), surface.curvature(i, 0) / um, surface.curvature(i, 1) / um);
  }
  return text;
}

std::string summary(const Result& result, const std::string& folder) {
  const auto& state = result.state;
  const auto& shape = state.shape;
  const auto& scales = result.scales;
  const double R = scales.length_m * um_per_m;
  std::string text = fmt::format("rheocyte {}: {}\n", version, name(state.outcome.status));
  text +=
      line("deformation", fmt::format("{:.6f}", shape.deformation), fmt::format("raw {:.6f}", shape.deformation_raw));
  text +=
      line("area", fmt::format("{:.3f} um^2", shape.area * R * R), fmt::format("raw {:.3f}", shape.area_raw * R * R));
  text += line("cell velocity", fmt::format("{:.5g} m/s", state.cell_velocity * scales.velocity_m_per_s),
               fmt::format("mean velocity of the liquid {:.5g}", scales.velocity_m_per_s));
  text += line("pressure drop", fmt::format("{:.5g} Pa", state.pressure_drop * scales.stress_Pa),
               fmt::format("{:.4g} due to the cell", state.additional_pressure_drop * scales.stress_Pa));
  if (const double reached = state.outcome.reached; reached > 0 && reached < 1) {
    const Cell& cell = result.input.cell;
    const auto modulus = [&](std::string_view name, const std::optional<double>& wanted, std::string_view unit) {
      if (!wanted) return;
      text += line(name, fmt::format("{:.5g} {}", *wanted / reached, unit), fmt::format("wanted {:.5g}", *wanted));
    };
    modulus("young modulus", cell.bulk.young_modulus_kPa, "kPa");
    modulus("cortex modulus", cell.cortex.modulus_mN_per_m, "mN/m");
  }
  if (std::isfinite(state.estimated_error))
    text += line("estimated error", fmt::format("{:.1e}", state.estimated_error),
                 fmt::format("of the deformation, wanted {:.1e}", result.problem.accuracy));
  text += line("time", fmt::format("{:.2f} s", state.statistics.total_s),
               fmt::format("{} steps, {} Newton iterations, {} unknowns", state.statistics.continuation_steps,
                           state.statistics.newton_iterations, state.statistics.unknowns));
  return text + fmt::format("  {:<18} {}\n", "folder", folder);
}

}  // namespace rheocyte

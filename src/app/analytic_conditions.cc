#include "app/analytic_conditions.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "app/cli.h"
#include "app/key_option.h"
#include "case/case_keys.h"
#include "case/scales.h"
#include "case/user_error.h"

namespace rheocyte {

namespace {

constexpr double standard_width_um = 20, standard_rate_ul_per_s = 0.04, standard_viscosity_mPas = 15;

}  // namespace

void declare_conditions(CLI::App& command, AnalyticConditions& conditions) {
  Channel& channel = conditions.input.channel;
  Flow& flow = conditions.input.flow;
  flow.rate_ul_per_s = standard_rate_ul_per_s;
  flow.viscosity_mPas = standard_viscosity_mPas;
  const auto add = [&](std::string_view key, std::optional<double>& target, double usual) {
    add_key_option(command, case_key(key), [&target](double value) {
      target = value;
    })->default_str(fmt::format("{:g}", usual));
  };
  add("channel.width_um", channel.width_um, standard_width_um);
  add("flow.rate_ul_per_s", flow.rate_ul_per_s, standard_rate_ul_per_s);
  add("flow.viscosity_mPas", flow.viscosity_mPas, standard_viscosity_mPas);
  command.add_flag("--square-duct", conditions.square_duct,
                   "use the velocity on the axis of the square channel, as in the published analytical tables; "
                   "default: velocity on the axis of the equivalent tube, as in simulated tables");
}

void complete(AnalyticConditions& conditions) {
  Channel& channel = conditions.input.channel;
  if (channel.width_um && channel.radius_um)
    throw UserError("rheocyte: --channel-width-um and --tube-radius-um exclude each other; give one of them.");
  if (channel.radius_um && conditions.square_duct)
    throw UserError("rheocyte: --square-duct is for square channels; give --channel-width-um.");
  if (!channel.radius_um && !channel.width_um) channel.width_um = standard_width_um;
}

double elastic_scale_kPa(const AnalyticConditions& conditions) {
  constexpr double Pa_per_kPa = 1e3;
  return std::numbers::pi * scales_of(conditions.input).stress_Pa / Pa_per_kPa;
}

double checked_radius_ratio(const AnalyticConditions& conditions, double radius_um, std::string_view option) {
  static_assert(max_radius_ratio <= max_sphere_in_tube);
  const double R = tube_radius_um(conditions.input), ratio = radius_um / R;
  if (!(ratio >= min_radius_ratio && ratio <= max_radius_ratio))
    throw UserError(
        fmt::format("rheocyte: {} {:g} is outside {:.4g} .. {:.4g} um, {} .. {} of the tube radius {:g} um.", option,
                    radius_um, min_radius_ratio * R, max_radius_ratio * R, min_radius_ratio, max_radius_ratio, R));
  return ratio;
}

}  // namespace rheocyte

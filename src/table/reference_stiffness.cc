#include "table/reference_stiffness.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "case/channel_flow.h"
#include "case/user_error.h"

namespace rheocyte {

namespace {

constexpr double max_exponent_difference = 0.01;

}  // namespace

ReferenceStiffness::ReferenceStiffness(const TableSpec& spec, const GridContent* tube) {
  if (!tube) return;
  const ChannelFlow flow = channel_flow_of(spec.base);
  if (std::abs(flow.exponent - tube->origin.flow.exponent) > max_exponent_difference ||
      tube->origin.section != Section::tube || tube->origin.is_shell)
    throw UserError(
        fmt::format("table.tube_table = {}: is not a table of solids in the tube in a liquid of exponent {:.4g}, "
                    "as the spec is for; name another one, or leave it out.",
                    tube->origin.identifier, flow.exponent));
  const ScaleFactors factors = scale_factors(tube->origin.flow, flow);
  log_area_factor_ = std::log(factors.area);
  log_modulus_factor_ = std::log(factors.modulus);
  grid_.emplace(*tube);
}

ReferenceStiffness::Value ReferenceStiffness::operator()(double radius_um, double log_deformation) const {
  if (!grid_) return {-log_deformation / 2, -0.5};
  constexpr double rim = 1e-6;
  const GridContent& content = grid_->content();
  const double first = content.min_log_area, last = first + content.column_step * (content.columns - 1);
  const double log_area = std::log(std::numbers::pi * radius_um * radius_um) - log_area_factor_;
  const double x = std::clamp(log_area, first + rim, last - rim);
  const auto range = *grid_->smooth_range(std::exp(x));
  const double y = std::clamp(log_deformation, range.lower + rim, range.upper - rim);
  const GridAnswer at = grid_->answer(std::exp(x), std::exp(y));
  const double beyond = (log_area - x) * at.by_log_area + (log_deformation - y) * at.by_log_deformation;
  return {log_modulus_factor_ + at.log_stiffness + beyond, at.by_log_deformation};
}

}  // namespace rheocyte

#include "extract/table_comparison.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>

namespace rheocyte {

namespace {

/// Of a block, whose moduli by another table tell more than enough of how far the two tables differ.
constexpr std::size_t most_compared = 1 << 12;

}  // namespace

void TableComparison::estimate(const MeasuringConditions& conditions, const MeasuredEvents& events) {
  if (!other_) return;
  const std::size_t count = std::min(events.size.size(), most_compared);
  modulus_.resize(count);
  standard_error_.resize(count);
  states_.resize(count);
  const auto of_some = [&](std::span<const double> column) { return column.first(count); };
  other_->estimate(conditions, {of_some(events.size), of_some(events.deformation), of_some(events.viscosity_mPas)},
                   {modulus_, standard_error_, states_});
}

void TableComparison::take(std::size_t i, double modulus_kPa) {
  if (i >= states_.size() || !has_modulus(states_[i])) return;
  log_ratios_ += std::log(modulus_[i] / modulus_kPa);
  ++compared_;
}

std::string TableComparison::sentence(double exponent) const {
  const auto way = [](const ModulusMap& table) {
    const std::string& name = table.origin().identifier;
    const double own = table.origin().flow.exponent;
    return own < 1 ? fmt::format("{} (its liquid has the exponent {:.3g})", name, own)
                   : fmt::format("{} with the effective viscosity", name);
  };
  const std::string text =
      fmt::format("the medium is shear-thinning (exponent {:.3g}); moduli are from {}", exponent, way(used_));
  if (compared_ == 0) return text + ".";
  const double percent = 100 * std::expm1(log_ratios_ / static_cast<double>(compared_));
  return fmt::format("{}; those from {} are {:.1f} % {} (geometric mean of {} events).", text, way(*other_),
                     std::abs(percent), percent < 0 ? "smaller" : "greater", compared_);
}

}  // namespace rheocyte

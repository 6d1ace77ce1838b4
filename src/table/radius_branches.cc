#include "table/radius_branches.h"

#include <algorithm>
#include <cmath>

namespace rheocyte {

RadiusBranches::RadiusBranches(const SampledBranch& first) : radius_um_(first.radius_um) { add(first); }

void RadiusBranches::add(const SampledBranch& branch) { (branch.bending_kBT > 0 ? regularised_ : bare_) = &branch; }

BranchPoint RadiusBranches::stiffest() const {
  const SampledBranch& branch = bare_ ? *bare_ : *regularised_;
  return point_at(branch, branch.stiffness.front());
}

BranchPoint RadiusBranches::softest() const {
  if (regularised_ &&
      is_beyond(regularised_->stiffness.back(), regularised_->at(regularised_->samples() - 1, Measure::deformation)))
    return point_at(*regularised_, regularised_->stiffness.back());
  return point_at(*bare_, bare_->stiffness.back());
}

bool RadiusBranches::is_beyond(double stiffness, double deformation) const {
  return !bare_ ||
         (stiffness < bare_->stiffness.back() && deformation > bare_->at(bare_->samples() - 1, Measure::deformation));
}

std::optional<BranchPoint> RadiusBranches::at_deformation(double deformation) const {
  if (bare_) {
    const double stiffness = stiffness_at(*bare_, Measure::deformation, deformation);
    if (std::isfinite(stiffness)) return point_at(*bare_, stiffness);
  }
  if (!regularised_) return {};
  const double stiffness = stiffness_at(*regularised_, Measure::deformation, deformation);
  if (!std::isfinite(stiffness) || !is_beyond(stiffness, deformation)) return {};
  return point_at(*regularised_, stiffness);
}

std::optional<BranchPoint> RadiusBranches::at_stiffness(double stiffness) const {
  const auto holds = [&](const SampledBranch* branch) {
    return branch && stiffness <= branch->stiffness.front() && stiffness >= branch->stiffness.back();
  };
  if (holds(bare_)) return point_at(*bare_, stiffness);
  if (!holds(regularised_) || !is_beyond(stiffness, interpolate(*regularised_, Measure::deformation, stiffness)))
    return {};
  return point_at(*regularised_, stiffness);
}

std::vector<RadiusBranches> by_radius(std::span<const SampledBranch> branches) {
  std::vector<const SampledBranch*> sorted;
  for (const auto& branch : branches)
    if (!branch.empty()) sorted.push_back(&branch);
  std::ranges::stable_sort(sorted, {}, &SampledBranch::radius_um);
  std::vector<RadiusBranches> radii;
  for (const auto* branch : sorted)
    if (radii.empty() || radii.back().radius_um() != branch->radius_um)
      radii.emplace_back(*branch);
    else
      radii.back().add(*branch);
  return radii;
}

BranchPoint point_at(const SampledBranch& branch, double stiffness) {
  const auto softer = std::upper_bound(branch.stiffness.begin(), branch.stiffness.end(), stiffness, std::greater<>());
  const auto last = std::size_t(branch.samples()) - 1;
  const auto behind = std::min(std::size_t(softer - branch.stiffness.begin()), last);
  const auto before = behind == 0 ? 0 : behind - 1;
  return {&branch, stiffness, std::max(branch.error[before], branch.error[behind]), branch.bending_kBT > 0};
}

double stiffness_error(const BranchPoint& point) {
  // A difference over 1 % of the stiffness, one-sided at the ends of the branch, is exact enough for an error.
  const SampledBranch& branch = *point.branch;
  const double stiff = std::min(1.005 * point.stiffness, branch.stiffness.front());
  const double soft = std::max(0.995 * point.stiffness, branch.stiffness.back());
  const double ratio =
      std::log(interpolate(branch, Measure::deformation, soft) / interpolate(branch, Measure::deformation, stiff));
  return ratio == 0 ? point.error : std::abs(point.error * std::log(stiff / soft) / ratio);
}

}  // namespace rheocyte

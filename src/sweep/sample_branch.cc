#include "sweep/sample_branch.h"

#include <algorithm>
#include <optional>

#include "sweep/follow_branch.h"
#include "sweep/sample_at_heights.h"
#include "table/radius_plan.h"

namespace rheocyte {
namespace {

/// Of the stiffness, by which held branches begin before the end of bare ones.
constexpr double overlap = 1.25;

}  // namespace

SampledBranch sample_branch(const TableSpec& spec, const SweepPoint& place, const std::atomic<bool>* stop) {
  return spec.is_square() ? sample_at_heights(spec, place, stop) : follow_branch(spec, place, std::nullopt, stop);
}

SampledBranch sample_regularised_branch(const TableSpec& spec, const SweepPoint& place, const SampledBranch& own,
                                        const std::atomic<bool>* stop) {
  if (!spec.is_square() && !can_be_regularised(spec, own)) return {};
  const TableSpec regularised = regularised_spec(spec);
  SampledBranch branch =
      spec.is_square()
          ? sample_at_heights(regularised, place, stop)
          : follow_branch(regularised, place, std::min(overlap * own.stiffness.back(), own.stiffness.front()), stop);
  if (!branch.empty()) branch.bending_kBT = regularising_bending_kBT(spec, place.radius_um, branch.stiffness.back());
  return branch;
}

}  // namespace rheocyte

// A branch followed state by state, as near to each other as the dense output between them needs: in the tube, where a
// state costs little.
#pragma once
#include <atomic>
#include <optional>

#include "table/branch.h"
#include "table/table_spec.h"

namespace rheocyte {

/// From the nearly undeformed sphere, or from a stiffness on; the way there is not sampled then.
SampledBranch follow_branch(const TableSpec&, const SweepPoint&, std::optional<double> first_stiffness,
                            const std::atomic<bool>* stop);

}  // namespace rheocyte

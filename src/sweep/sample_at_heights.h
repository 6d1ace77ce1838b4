// A branch as the few states through which polynomials run: in a square channel, where a state costs much.
#pragma once
#include <atomic>

#include "table/branch.h"
#include "table/table_spec.h"

namespace rheocyte {

/// As many states as the spec says; slopes are those of the polynomials through them.
SampledBranch sample_at_heights(const TableSpec&, const SweepPoint&, const std::atomic<bool>* stop);

}  // namespace rheocyte

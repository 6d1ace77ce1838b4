// The computed states of one radius in a square channel (docs/tables.md, sec. "Square channels").
#pragma once
#include <atomic>

#include "table/branch.h"
#include "table/table_spec.h"

namespace rheocyte {

/// As many states as the spec says, from nearly undeformed to the greatest deformation or the end of the branch; slopes
/// are those of the polynomials through them. Empty if there are none.
SampledBranch sample_square_branch(const TableSpec&, const SweepPoint& place, const std::atomic<bool>* stop = nullptr);

/// The same of the cells whose surface is held by bending.
SampledBranch sample_regularised_square_branch(const TableSpec&, const SweepPoint& place,
                                               const std::atomic<bool>* stop = nullptr);

}  // namespace rheocyte

// Samples of one branch of a table, each a state within the requested accuracy, stiff to soft (docs/theory.md, sec.
// "tables"; docs/tables.md, sec. "Square channels").
#pragma once
#include <atomic>

#include "table/branch.h"
#include "table/table_spec.h"

namespace rheocyte {

/// The case's own branch, from the least deformation to the greatest one or to the branch's end. Empty if it has no
/// state.
SampledBranch sample_branch(const TableSpec&, const SweepPoint&, const std::atomic<bool>* stop = nullptr);

/// The same cell with a surface that the bending stiffness of the spec holds. In the tube it goes on where `own` ended
/// because its bare surface lost stability, from a state before the end on, so that both overlap; empty if there is
/// nothing to go on from. In a square channel it is a whole branch of its own.
SampledBranch sample_regularised_branch(const TableSpec&, const SweepPoint&, const SampledBranch& own,
                                        const std::atomic<bool>* stop = nullptr);

}  // namespace rheocyte

// Samples of the branch of one radius: followed from stiff to soft, each state within the wanted accuracy, as many as
// the dense output between them needs (docs/theory.md, sec. "tables").
#pragma once
#include <atomic>

#include "table/branch.h"
#include "table/table_spec.h"

namespace rheocyte {

/// The case's own branch, from the least deformation to the greatest one or to the branch's end.
SampledBranch sample_branch(const TableSpec&, const SweepPoint& place, const std::atomic<bool>* stop = nullptr);

/// Goes on where `own` ended because its bare surface lost stability: the same cell with the bending stiffness of the
/// spec, from a state before the end on, so that both overlap. Empty if there is nothing to go on from.
SampledBranch sample_regularised_branch(const TableSpec&, const SampledBranch& own,
                                        const std::atomic<bool>* stop = nullptr);

}  // namespace rheocyte

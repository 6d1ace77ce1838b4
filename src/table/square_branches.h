// The branches of a square channel between some computed states (docs/tables.md, sec. "Square channels").
#pragma once
#include <span>
#include <vector>

#include "table/branch.h"
#include "table/stiffness_grid.h"
#include "table/table_spec.h"

namespace rheocyte {

/// Whether enough radii have states.
bool can_lie_between(std::span<const SampledBranch> computed);

/// The branches of all radii of the spec with dense samples. In the coordinates r0 and sqrt(d) over the length of the
/// branch, polynomials run through the computed states: of the measures, of the contours, and of ln(E / E_tube), where
/// E_tube is the modulus that the tube's table gives to a cell of this area and deformation; of ln(E sqrt(d)) without a
/// tube. The error of a sample is that of the computed states and that of the polynomials. UserError if too few radii
/// have states, or the tube's table is that of another liquid.
std::vector<SampledBranch> square_branches(const TableSpec&, std::span<const SampledBranch> computed,
                                           const GridContent* tube);

/// How well ln(E) of a computed state is met by polynomials through the others: the greatest difference, leaving out
/// one radius after the other (but the first and the last one), and one state of each branch after the other.
struct LeftOut {
  double radius = 0, state = 0;
};
LeftOut left_out(const TableSpec&, std::span<const SampledBranch> computed, const GridContent* tube);

}  // namespace rheocyte

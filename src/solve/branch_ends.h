// Where the smooth branches of bare solids in a Newtonian liquid end, known beforehand.
#pragma once
#include <optional>

#include "case/problem.h"

namespace rheocyte {

/// Least shear modulus (in S) of a bare solid, `linear` or neo-Hookean, whose surface is smooth in a Newtonian liquid
/// with a given flow rate, within 2 %; none for other problems (docs/theory.md, sec. "ends of branches").
std::optional<double> min_shear_modulus(const Problem&);

/// Whether the problem is so far beyond the end of its branch that it need not be tried.
bool is_far_too_soft(const Problem&);

/// The problem with a modulus just above the end of its branch; only where that is known.
Problem at_end_of_branch(const Problem&);

}  // namespace rheocyte

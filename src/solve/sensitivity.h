// How a state changes with a parameter of its problem: one linear system with the factors at hand
// (docs/theory.md, sec. "Gradients").
#pragma once
#include <span>

#include "case/problem.h"
#include "solve/geometry.h"
#include "solve/ladder.h"
#include "solve/stationary.h"

namespace rheocyte {

/// Fills in the states of lines around the problem of a converged state, from the state's changes to first order. A
/// line is empty afterwards if one of its problems has another mesh or other laws, if the tangent is singular, or if
/// the system of this line is not solved. The state keeps or gets its factors.
void follow_lines(const Geometry&, const Problem&, ResolvedState&, std::span<ProblemLine>);

}  // namespace rheocyte

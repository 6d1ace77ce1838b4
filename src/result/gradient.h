// How the numbers of a result change with those of its case (docs/theory.md, sec. "Gradients").
#pragma once
#include <functional>
#include <span>
#include <string>
#include <string_view>

#include "result/result.h"

namespace rheocyte {

/// Solves a problem, and follows lines around it.
using SolveWithLines = std::function<StationaryState(const Problem&, std::span<ProblemLine>)>;

/// Which derivatives a converged state has not, though it has the numbers, in a sentence; empty if it has all.
std::string missing_gradients(const Result&);

/// The result of a stationary case, with its gradients by these keys (asked_line_keys), in their order; those
/// that are missing are named in the message of its outcome, too.
Result solve_with_gradients(const Case&, std::span<const std::string_view> keys, const SolveWithLines&);

}  // namespace rheocyte

// In which order subdomains are joined for the elimination of NestedLU.
#pragma once
#include <array>
#include <vector>

#include "fem/nested_lu.h"

namespace rheocyte {

/// A subdomain: an element, or two earlier subdomains together.
struct Subdomain {
  std::array<int, 2> parts{-1, -1};
  std::vector<int> eliminated, remaining;  ///< unknowns
};

/// The elements, then what they are joined to, the whole last: of several greedy orders the one with the fewest
/// operations.
std::vector<Subdomain> nested_order(int unknowns, const std::vector<CoupledUnknowns>&);

/// Operations of eliminating `f` unknowns from a dense matrix that has `o` more.
inline double elimination_flops(double f, double o) { return f * f * f * 2 / 3 + 2 * f * f * o + 2 * f * o * o; }

}  // namespace rheocyte

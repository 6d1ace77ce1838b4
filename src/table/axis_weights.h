// Polynomials between the nodes of one coordinate, some of which count only in part.
#pragma once
#include <functional>
#include <span>
#include <vector>

#include "table/cell_coordinates.h"

namespace rheocyte {

/// The interval of ascending nodes that holds x, or the nearest one.
int interval_of(std::span<const double> nodes, double x);

struct NodeWeight {
  int node;
  CellFunction weight;
};

/// Of the polynomial through up to four nodes around the cell: the two next ones in any case, then as many on both
/// sides as there are, without gaps. `part_of` tells how much another node counts, from 0 to 1; what it leaves belongs
/// to the polynomial without it, so that the sum changes smoothly with the part.
std::vector<NodeWeight> axis_weights(std::span<const double> nodes, const CellCoordinates& cell, int coordinate,
                                     const std::function<CellFunction(int)>& part_of);

}  // namespace rheocyte

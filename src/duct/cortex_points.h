// Energies of a cortex at a point of a face or an edge, as functions of numbers that are independent.
#pragma once
#include <array>

#include "laws/bending_form.h"
#include "laws/membrane_form.h"

namespace rheocyte {

/// The x, y and z of a part.
template <class T, std::size_t count>
Vector<T> vector_of(const std::array<T, count>& numbers, int part) {
  return {numbers[3 * part], numbers[3 * part + 1], numbers[3 * part + 2]};
}

/// Of the derivatives of the position by s, t, and both twice.
struct BentShellAtPoint {
  MembranePoint membrane;

  template <class T>
  T operator()(const std::array<T, 15>& n) const {
    const SurfaceSlopes<T> slopes{vector_of(n, 0), vector_of(n, 1), vector_of(n, 2), vector_of(n, 3), vector_of(n, 4)};
    return membrane(MembraneFields<T>{slopes.a, slopes.b}) + BendingPoint{membrane.law}(slopes);
  }
};

/// What an energy does on its numbers, and the load that has none.
template <class Energy, class T, std::size_t count>
std::array<T, count> work_of(const Energy& energy, const std::array<T, count>& numbers) {
  std::array<T, count> work = value_and_slopes(energy, numbers).second;
  if constexpr (requires { energy.pull(numbers); }) work[0] = work[0] - energy.pull(numbers);
  return work;
}

/// Of a fold between two faces: the derivatives along the edge are theirs in common.
struct BentEdgeAtPoint {
  BendingEdge edge;

  template <class T>
  T operator()(const std::array<T, 24>& n) const {
    const Vector<T> a = vector_of(n, 0), aa = vector_of(n, 1);
    return edge(SurfaceSlopes<T>{a, vector_of(n, 2), aa, vector_of(n, 3), vector_of(n, 4)},
                SurfaceSlopes<T>{a, vector_of(n, 5), aa, vector_of(n, 6), vector_of(n, 7)});
  }
};

}  // namespace rheocyte

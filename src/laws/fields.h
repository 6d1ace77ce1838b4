// Named fields at a point, the inputs of the weak forms. A structure of fields lists its numbers once, in `visit`:
// dual numbers are read in the order of that list, and the columns of an element know from it which numbers they feed.
#pragma once
#include <vector>

#include "laws/tensor.h"

namespace rheocyte {

/// What the columns of an element are values of.
enum class Source { position, velocity, pressure, frame };

/// One number of a structure of fields: a component of what its source makes, the value (part 0) or the derivative with
/// respect to xi_part.
struct Input {
  Source source;
  int component = 0, part = 0;
};

template <class Visitor, class Vector>
void visit_vector(const Visitor& on, Source source, Vector& v, int part = 0) {
  for (int c = 0; c < v.size(); ++c) on(Input{source, c, part}, v(c));
}

/// Derivatives d(v)/d(xi), row by row.
template <class Visitor, class Matrix>
void visit_slopes(const Visitor& on, Source source, Matrix& v_xi) {
  for (int c = 0; c < v_xi.rows(); ++c) {
    for (int k = 0; k < v_xi.cols(); ++k) on(Input{source, c, k + 1}, v_xi(c, k));
  }
}

/// What a weak form does on the test functions of a point, per d(xi): value . phi + slope : d(phi)/d(xi), and on that
/// of the pressure.
template <class T, int dim>
struct Flux {
  Components<T, dim> value;
  Slopes<T, dim> slope;
  T pressure{};

  /// Its numbers: component by component the value and the slopes, the pressure last.
  static constexpr int count = dim * (1 + dim) + 1;
  template <class Visitor>
  void visit(const Visitor& on) const {
    for (int c = 0; c < dim; ++c) {
      on(value(c));
      for (int k = 0; k < dim; ++k) on(slope(c, k));
    }
    on(pressure);
  }
};

/// A structure of fields whose numbers are number(0), number(1), ...
template <class Fields, class Number>
Fields read_fields(const Number& number) {
  Fields fields;
  int i = 0;
  fields.visit([&](const Input&, auto& value) { value = number(i++); });
  return fields;
}

/// The numbers of a structure of fields, in turn.
template <class Fields>
std::vector<Input> inputs_of() {
  std::vector<Input> inputs;
  Fields{}.visit([&](const Input& input, auto&) { inputs.push_back(input); });
  return inputs;
}

}  // namespace rheocyte

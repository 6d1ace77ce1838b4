// Numbers as scalars of any type.
#pragma once
#include <type_traits>

namespace rheocyte {

/// A number as a scalar of type T, which may be a dual number of dual numbers.
template <class T>
T constant(double value) {
  if constexpr (std::is_same_v<T, double>) {
    return value;
  } else {
    return T(constant<typename T::Scalar>(value));
  }
}

}  // namespace rheocyte

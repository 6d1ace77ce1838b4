// Special functions of the standard that not every library of it has (libc++ lacks them).
#pragma once

namespace rheocyte {

/// Legendre polynomial P_n(x), -1 <= x <= 1; to 1e-14 up to n = 30.
double legendre(int n, double x);

/// Modified Bessel functions of integer order n >= 0, x > 0, times exp(-x) and exp(x): products of both need no factor,
/// and neither leaves the range of numbers. To 1e-13 relative for 1e-3 <= x <= 1e3, n <= 2.
double scaled_bessel_i(int n, double x);
double scaled_bessel_k(int n, double x);

}  // namespace rheocyte

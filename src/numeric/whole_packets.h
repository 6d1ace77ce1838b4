// Arrays that the processor works on several numbers at a time.
#pragma once
#include <Eigen/Core>
#include <algorithm>
#include <cstddef>

namespace rheocyte {

/// The least length of whole packets that holds so many numbers. Functions such as exp of a packet and of a single
/// number differ in the last digit: over whole packets the result of one event does not depend on who stands beside it.
inline std::ptrdiff_t whole_packets(std::size_t count) { return static_cast<std::ptrdiff_t>((count + 15) / 16 * 16); }

/// So many numbers are one for the processor. Laws that hold for a number and for a packet are templates of either.
using Packet = Eigen::Array4d;
inline constexpr std::ptrdiff_t packet_size = Packet::SizeAtCompileTime;

/// NaN stays NaN: in Eigen's as in the standard library's order of operands the first one is kept.
inline double clamped(double x, double least, double greatest) { return std::clamp(x, least, greatest); }
inline Packet clamped(const Packet& x, double least, double greatest) { return x.max(least).min(greatest); }
inline double at_least(double x, double least) { return x < least ? least : x; }
inline Packet at_least(const Packet& x, double least) { return x.max(least); }

}  // namespace rheocyte

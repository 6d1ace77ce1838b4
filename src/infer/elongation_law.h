// What a tension of the liquid along the flow does to area and asymmetry of an outline (docs/theory-extract.md,
// sec. "elongated cells").
#pragma once
#include <array>

#include "numeric/whole_packets.h"

namespace rheocyte {

/// Smooth outlines, one or a Packet of them: what their c_2 have beyond that of the model's cell of the same size and
/// modulus without the tension, |c_3|, and ln(area) in units of half the channel's width, squared.
template <class Number>
struct LongOutlineOf {
  Number excess, mode_3, log_area;
};
using LongOutline = LongOutlineOf<double>;

/// Coefficients of excess^i |c_3|^j r^k, i from 1 on, r the radius of a circle of this area.
using ElongationLaw = std::array<double, 18>;
template <class Number>
std::array<Number, 18> elongation_terms(const LongOutlineOf<Number>&);

/// To be added to ln|c_3| and to ln(area) of an outline, so that they become those of the cell without the tension.
/// Beyond what the law was fitted to the nearest counts; nothing without an excess.
struct WithoutElongation {
  Packet log_mode_3, log_area;
  Packet deviation;  ///< standard deviation of what the law leaves of ln|c_3|
};
WithoutElongation without_elongation(const LongOutlineOf<Packet>&);

}  // namespace rheocyte

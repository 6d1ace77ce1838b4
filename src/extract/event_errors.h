// What is said of the modulus of one event after its table has given it: the liquid's inertia, and whether it is
// resolved.
#pragma once
#include <cmath>

#include "events/plausibility.h"
#include "infer/modulus_state.h"
#include "numeric/no_value.h"

namespace rheocyte {

/// With more an event has no modulus.
inline constexpr double max_relative_standard_error = 1;

/// What is known of inertia counts as an error of the modulus; an event beyond that is flagged.
inline void add_inertia_error(double reynolds, double modulus_kPa, double& standard_error_kPa, ModulusState& state) {
  if (!has_modulus(state)) return;
  const double by_inertia = modulus_per_reynolds * reynolds * modulus_kPa;
  // The same digits wherever it is compiled, in a fraction of the time of std::hypot.
  standard_error_kPa = std::sqrt(std::fma(by_inertia, by_inertia, standard_error_kPa * standard_error_kPa));
  if (reynolds > max_reynolds_number) state = ModulusState::inertial;
}

/// Where the deformation or the asymmetry is lost in the scatter by pixels, the modulus could be any above some value.
inline void mark_unresolved(double& modulus_kPa, double& standard_error_kPa, ModulusState& state) {
  if (!has_modulus(state) || standard_error_kPa <= max_relative_standard_error * modulus_kPa) return;
  modulus_kPa = standard_error_kPa = no_value;
  state = ModulusState::unresolved;
}

}  // namespace rheocyte

// What is said about the modulus of each event.
#pragma once
#include <array>
#include <string_view>

namespace rheocyte {

/// The numbers are those that files hold (feature userdef0); they never change their meaning.
enum class ModulusState : int {
  valid = 0,
  no_data = 1,    ///< area, deformation or viscosity is not a finite number
  too_small = 2,  ///< smaller than any cell of the table at this channel width
  too_large = 3,
  too_stiff = 4,  ///< deformed less than the stiffest cell of the table of this area
  too_soft = 5    ///< deformed more than the softest cell of the table of this area
};

inline constexpr std::array<std::string_view, 6> names_of_modulus_states{"valid",     "no data",   "too small",
                                                                         "too large", "too stiff", "too soft"};

inline std::string_view name_of(ModulusState state) {
  return names_of_modulus_states.at(static_cast<std::size_t>(state));
}

}  // namespace rheocyte

// What is said about the modulus of each event.
#pragma once
#include <array>
#include <span>
#include <string_view>

namespace rheocyte {

/// The numbers are those that files hold; they never change their meaning.
enum class ModulusState : int {
  valid = 0,
  no_data = 1,    ///< area, deformation or viscosity is not a finite number
  too_small = 2,  ///< smaller than any cell of the table at this channel width
  too_large = 3,
  too_stiff = 4,       ///< deformed less than the stiffest cell of the table of this area
  too_soft = 5,        ///< deformed more than the softest cell of the table of this area
  unstable = 6,        ///< the bare surface of such a soft cell wrinkles: beyond the end of the smooth states
  unresolved = 7,      ///< the standard error is greater than the modulus; or a gap of the table
  regularised = 8,     ///< there is a modulus, of a cell whose surface is held smooth by bending
  gated = 9,           ///< outside the limits that the user set
  inertial = 10,       ///< there is a modulus, but the liquid's inertia, which the table does not hold, changes it
  too_round = 11,      ///< of a table of elongated cells: flatter than any of them
  too_elongated = 12,  ///< longer than any of them
  cut = 13             ///< the outline touches the edge of the picture: it is not that of the whole cell
};

inline constexpr std::array<std::string_view, 14> names_of_modulus_states{
    "valid",      "no data",     "too small", "too large", "too stiff", "too soft",      "unstable",
    "unresolved", "regularised", "gated",     "inertial",  "too round", "too elongated", "cut by the edge"};

/// Those of a modulus from area and deformation, but for `cut`.
inline std::span<const std::string_view> states_by_deformation() {
  return std::span(names_of_modulus_states).first(std::size_t(ModulusState::too_round));
}

inline std::string_view name_of(ModulusState state) {
  return names_of_modulus_states.at(static_cast<std::size_t>(state));
}

/// What is meant, in one sentence; empty for a modulus about which nothing is to be said.
std::string_view sentence_of(ModulusState state);

/// Whether there is a modulus.
inline bool has_modulus(ModulusState state) {
  return state == ModulusState::valid || state == ModulusState::regularised || state == ModulusState::inertial;
}

}  // namespace rheocyte

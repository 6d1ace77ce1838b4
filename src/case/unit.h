// Units of results and keys. A name carries its unit as its last part ("area_um2", "rate_ul_per_s"), and what has a
// unit has a dimension.
#pragma once
#include <array>
#include <numbers>
#include <string_view>

#include "case/physical_scales.h"

namespace rheocyte {

/// Exponents of the units of the dimensionless problem, R, U and S of case/physical_scales.h, in a quantity.
struct Dimension {
  int length = 0, velocity = 0, stress = 0;
  bool operator==(const Dimension&) const = default;
};

/// k_B T at 25 degrees C, the unit of bending stiffness.
inline constexpr double thermal_energy_J = 1.380649e-23 * 298.15;

struct Unit {
  std::string_view suffix;  ///< of names, after an underscore
  std::string_view symbol;
  Dimension dimension;
  double per_SI = 1;  ///< so many of it are one SI unit
};

/// Of a name without a unit: a pure number or a word.
inline constexpr Unit no_unit{};

/// In "Pa_sn" the power of the time depends on the liquid; no dimension can be determined.
inline constexpr std::array units{Unit{"um", "um", {1, 0, 0}, 1e6},
                                  Unit{"um2", "um^2", {2, 0, 0}, 1e12},
                                  Unit{"um3", "um^3", {3, 0, 0}, 1e18},
                                  Unit{"per_um", "1/um", {-1, 0, 0}, 1e-6},
                                  Unit{"us", "us", {1, -1, 0}, 1e6},
                                  Unit{"s", "s", {1, -1, 0}},
                                  Unit{"per_s", "1/s", {-1, 1, 0}},
                                  Unit{"m_per_s", "m/s", {0, 1, 0}},
                                  Unit{"ul_per_s", "ul/s", {2, 1, 0}, 1e9},
                                  Unit{"Pa", "Pa", {0, 0, 1}},
                                  Unit{"kPa", "kPa", {0, 0, 1}, 1e-3},
                                  Unit{"mN_per_m", "mN/m", {1, 0, 1}, 1e3},
                                  Unit{"mPas", "mPa s", {1, -1, 1}, 1e3},
                                  Unit{"Pa_sn", "Pa s^n", {}},
                                  Unit{"kBT", "kBT", {3, 0, 1}, 1 / thermal_energy_J},
                                  Unit{"kg_per_m3", "kg/m3", {0, -2, 1}},
                                  Unit{"degree", "degree", {}, 180 / std::numbers::pi}};

/// The unit that a name ends with.
constexpr const Unit& unit_of(std::string_view name) {
  const Unit* longest = &no_unit;
  for (const Unit& unit : units) {
    const bool fits = name.size() > unit.suffix.size() && name.ends_with(unit.suffix) &&
                      name[name.size() - unit.suffix.size() - 1] == '_';
    if (fits && unit.suffix.size() > longest->suffix.size()) longest = &unit;
  }
  return *longest;
}

/// The size of the dimensionless problem's unit of a quantity, in a physical unit: a length of 1 is R.
constexpr double dimensionless_one(const Unit& unit, const Scales& scales) {
  double size = unit.per_SI;
  const auto multiply = [&size](double base, int exponent) {
    for (; exponent > 0; --exponent) size *= base;
    for (; exponent < 0; ++exponent) size /= base;
  };
  multiply(scales.length_m, unit.dimension.length);
  multiply(scales.velocity_m_per_s, unit.dimension.velocity);
  multiply(scales.stress_Pa, unit.dimension.stress);
  return size;
}

}  // namespace rheocyte

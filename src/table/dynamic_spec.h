// What a dynamic table is to contain: a case in time without its cell, and the ranges of its cells (docs/tables.md,
// sec. "dynamic tables").
#pragma once
#include <array>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "case/case.h"
#include "case/key.h"
#include "case/key_reference.h"

namespace rheocyte {

struct DynamicSpec {
  std::string identifier;
  Case base;  ///< radius, modulus, viscosity and ends of the way hold those of one of the cells and mean nothing
  double min_radius_um = 0, max_radius_um = 0;
  double min_young_modulus_kPa = 0, max_young_modulus_kPa = 0;  ///< of the largest cells
  double min_time_ms = 0, max_time_ms = 0;                      ///< 3 x viscosity / Young's modulus
  double first_um = 0, last_um = 0;                             ///< behind the last change of the wall
  int radii = 0, moduli = 0, times = 0, places = 0;
  int checks = 0;  ///< cells between the nodes that are computed as well, to compare with
};

/// Deformations of different radii are alike where the modulus rises with this power of the radius.
inline constexpr double power_of_radius = 1.5;

/// One cell of the table.
struct DynamicCell {
  double radius_um = 0, young_modulus_kPa = 0, time_ms = 0;
  double viscosity_mPas() const { return young_modulus_kPa * time_ms / 3 * 1e3; }  // kPa ms = Pa s
};

/// Radius, ln(E / kPa) of the largest cells, ln(3 eta / E / ms): in these the table is a polynomial in each direction.
using DynamicCoordinates = std::array<double, 3>;
DynamicCoordinates coordinates_of(const DynamicSpec&, const DynamicCell&);
DynamicCell cell_at(const DynamicSpec&, const DynamicCoordinates&);
/// Chebyshev nodes with both ends, ascending.
std::array<std::vector<double>, 3> nodes_of(const DynamicSpec&);

/// The keys of the section [dynamic].
std::span<const Key<DynamicSpec>> dynamic_keys();
Reference dynamic_reference();
/// Whether a spec has that section.
bool is_dynamic_spec(std::string_view text, const std::string& name, std::span<const std::string> settings);

/// UserError as read_case.
DynamicSpec parse_dynamic_spec(std::string_view text, const std::string& name,
                               std::span<const std::string> settings = {});
/// The complete spec as text with all defaults; parses back to the same spec.
std::string to_toml(const DynamicSpec&);
std::string spec_hash(const DynamicSpec&);

/// The cells at the nodes, that of the last coordinate running fastest, and behind them those to compare with.
std::vector<DynamicCell> cells_of(const DynamicSpec&);
int nodes(const DynamicSpec&);

/// Where the wall no longer changes (um).
double end_of_contraction_um(const Case&);
/// Places along the channel behind it (um), at equal distances.
std::vector<double> places_of(const DynamicSpec&);

/// The case of one cell, to be followed to the last place.
Case case_of(const DynamicSpec&, const DynamicCell&);

}  // namespace rheocyte

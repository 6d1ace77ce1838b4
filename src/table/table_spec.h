// What a look-up table is to contain: a case without radius and stiffness, and the ranges of the sweep.
#pragma once
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "case/case.h"

namespace rheocyte {

/// What is swept when the cell has a bulk and a cortex: S = E + E2D / r0 in kPa, E = (1 - fraction) S, E2D = fraction S
/// r0 (docs/tables.md, sec. "combined cells").
inline constexpr std::string_view combined_stiffness = "combined";

/// By what the cells of a table are longer than the flow makes them.
enum class Elongation { by_tension, by_rest_shape };

/// The cells of one branch; fraction and tension of the cortex have a meaning for combined cells only.
struct SweepPoint {
  double radius_um = 0;        ///< of the sphere at rest
  double cortex_fraction = 0;  ///< (E2D / r0) / S
  double tension_ratio = 0;    ///< gamma / E2D
  /// flow.axial_tension_Pa over the swept stiffness, E or S; of cells that are long at rest that which would draw a
  /// sphere out as much (aspect_by_tension).
  double axial_ratio = 0;
};

struct TableSpec {
  std::string identifier;     ///< of the table, e.g. "LE-2D-26": letters, digits, hyphens
  Case base;                  ///< radius and stiffness hold the values of the sweep's middle and mean nothing
  std::string stiffness_key;  ///< the swept parameter, "cell.bulk.young_modulus_kPa", "cell.cortex.modulus_mN_per_m" or
                              ///< combined_stiffness
  double min_area_um2 = 0, max_area_um2 = 0;  ///< of the deformed cell
  double min_deformation = 0, max_deformation = 0;
  int radii = 0;  ///< branches, equally spaced in the radius of the sphere
  int rows_per_radius = 0;
  double accuracy = 0;  ///< relative, of the deformation
  /// Bending stiffness of the branches that go on where the bare surface has lost its stability, in a square channel
  /// over S r0^3; 0: none.
  double bending_beyond_kBT = 0, bending_beyond_ratio = 0;
  double bending_from_margin = 0;  ///< in a square channel: bare branches end where the surface is that stable
  std::vector<double> cortex_fractions, tension_ratios;  ///< of combined cells, ascending; else empty
  std::vector<double> axial_ratios;                      ///< of elongated cells, ascending; else empty
  Elongation elongation = Elongation::by_tension;        ///< of them
  double bending_ratio = 0;        ///< c_b / (S r0^3), S = E or E2D / r0; 0: the base's bending stiffness for all
  double max_deformation_raw = 1;  ///< of the contour itself, dent included: where branches of combined cells end
  /// In a square channel: branches and states on each that are computed, between which the others lie, and the tube's
  /// table by whose ratio they are interpolated, as the user names it; without one the moduli themselves are.
  std::optional<int> computed_radii, computed_states;
  std::optional<std::string> tube_table;

  bool is_combined() const { return stiffness_key == combined_stiffness; }
  bool sweeps_cortex() const { return stiffness_key == "cell.cortex.modulus_mN_per_m"; }
  bool is_elongated() const { return !axial_ratios.empty(); }
  bool is_square() const { return base.channel.section == Section::square; }
  bool wants_regularised() const { return bending_beyond_kBT > 0 || bending_beyond_ratio > 0; }
};

/// Reads a spec: the keys of a case and those of the section [table]. UserError as read_case.
TableSpec read_table_spec(const std::filesystem::path&, std::span<const std::string> settings = {});
TableSpec parse_table_spec(std::string_view text, const std::string& name, std::span<const std::string> settings = {});

/// The complete spec as text with all defaults; parses back to the same spec.
std::string to_toml(const TableSpec&);
/// Of that text, 16 hexadecimal digits.
std::string spec_hash(const TableSpec&);

/// The spheres of the sweep, in um, ascending.
std::vector<double> sweep_radii_um(const TableSpec&);
/// Those that are computed in a square channel: Chebyshev's points in `radius_coordinate`, denser towards both ends.
std::vector<double> computed_radii_um(const TableSpec&);
/// Over which cells of a square channel vary smoothly up to the largest: where the gap to the wall closes it is nearly
/// the gap's logarithm. For r0 / h.
double radius_coordinate(double radius_ratio);
/// Its inverse.
double radius_ratio_at(double radius_coordinate);

/// All branches of the sweep: radius by radius within each fraction, fraction by fraction within each tension of the
/// cortex, and that within each axial tension. Cells without a cortex have no tension of it: they stand once, with the
/// first one.
std::vector<SweepPoint> sweep_places(const TableSpec&);

/// The case of one cell of the table.
Case case_at(const TableSpec&, const SweepPoint& place, double stiffness);

/// The same cells, all with the bending stiffness that holds their surface.
TableSpec regularised_spec(TableSpec);
/// Bending stiffness of such a cell.
double regularising_bending_kBT(const TableSpec&, double radius_um, double stiffness);

}  // namespace rheocyte

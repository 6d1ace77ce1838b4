// Solids that are elongated along the flow: a table with one number more (docs/tables.md, sec. "elongated cells").
#pragma once
#include <Eigen/Core>
#include <array>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "shape/radius_modes.h"
#include "table/branch.h"
#include "table/table_origin.h"
#include "table/table_spec.h"

namespace rheocyte {

/// What is known of a state: ln of its area over that of the sphere, d, and of the hull the inertia ratio and the modes
/// of the radius from c_2 on.
enum class ElongatedMeasure { log_area_ratio, deformation, inertia_ratio, mode_2, mode_3 };
inline constexpr int elongated_measures = int(ElongatedMeasure::mode_2) + int(std::tuple_size_v<RadiusModes>);
constexpr int number_of(ElongatedMeasure measure) { return int(measure); }

/// The states that were computed. All branches have equally many.
struct ElongatedContent {
  TableOrigin origin;
  std::vector<double> radii_um, axial_ratios;  ///< ascending; of the sphere, and as in SweepPoint
  Elongation elongation = Elongation::by_tension;
  int states = 0;
  /// By radius, within it by axial ratio, within that from stiff to soft.
  std::vector<double> modulus_kPa;
  std::array<std::vector<double>, std::size_t(elongated_measures)> value;
  double error = 0;  ///< estimated, relative, of the modulus between the states

  std::size_t branch(std::size_t radius, std::size_t axial) const {
    return (radius * axial_ratios.size() + axial) * std::size_t(states);
  }
};

/// UserError naming a cell whose branch has no states.
ElongatedContent elongated_content(const TableSpec&, std::span<const SampledBranch> branches, std::string_view version);

/// The file: CBOR with a checksum.
std::string to_bytes(const ElongatedContent&);
/// Bytes of it at most.
inline constexpr std::size_t largest_elongated = std::size_t{16} << 20U;
/// UserError naming `name` if the bytes are damaged or no such table.
ElongatedContent elongated_from_bytes(std::string_view bytes, const std::string& name);
/// Of the file beside the other files of a table: elongated_<identifier>.cbor.
std::string elongated_file_name(const std::string& identifier);

/// Coordinates of a cell: the radius in fractions of the way from the least to the greatest one (radius_coordinate),
/// the axial ratio, and the height: its compliance 1 / E as a fraction of that at the end of its branch.
enum class ElongatedCoordinate { radius, axial_ratio, height };
using ElongatedCell = Eigen::Vector3d;

/// A cell's measures, by ElongatedMeasure, their slopes by the coordinates, and its modulus.
struct ElongatedState {
  Eigen::Array<double, elongated_measures, 1> value;
  Eigen::Array<double, elongated_measures, 3> slope;
  double radius_um = 0, log_modulus = 0;  ///< ln(kPa)
  Eigen::Vector3d log_modulus_slope;
  double log_radius_slope = 0;  ///< by the first coordinate

  /// ln(area / um2) of the cell, and its slopes.
  double log_area() const;
  Eigen::Vector3d log_area_slope() const;
};

/// The radius in fractions of the way from the least to the greatest one of a table, by radius_coordinate.
struct RadiusScale {
  explicit RadiusScale(const ElongatedContent& content);
  double fraction_of(double radius_um) const;
  double radius_um(double fraction) const;
  double log_radius_slope(double fraction) const;

  double half_width_um, first, last;
};

/// Between the states: polynomials along the branches, over the axial ratio and over the radius, of which nodes are
/// kept for cubic interpolation.
class ElongatedTable {
 public:
  explicit ElongatedTable(ElongatedContent content);

  const TableOrigin& origin() const { return content_.origin; }
  Elongation elongation() const { return content_.elongation; }
  double error() const { return content_.error; }
  /// In fractions of a branch: a stiffer cell is a sphere for a camera, or an ellipsoid by the elongation alone.
  static constexpr double min_height = 1e-3;
  ElongatedCell least() const { return {0, content_.axial_ratios.front(), 0}; }
  ElongatedCell greatest() const { return {1, content_.axial_ratios.back(), 1}; }

  /// A little beyond the table's cells, too; a height that is not positive is none (asserted).
  ElongatedState at(const ElongatedCell&) const;
  /// The same sphere with the same modulus under no tension; the softest that is stable, if it is not.
  ElongatedCell without_elongation(const ElongatedCell&) const;
  /// First coordinate of a sphere's radius.
  double coordinate_of(double radius_um) const { return scale_.fraction_of(radius_um); }
  /// Of a first coordinate.
  double radius_um(double coordinate) const { return scale_.radius_um(coordinate); }

 private:
  static constexpr int numbers = elongated_measures + 1;  ///< the last one is ln(kPa) at the end of the branch
  using Node = Eigen::Array<double, numbers, 1>;

  ElongatedContent content_;
  RadiusScale scale_;
  std::vector<Node> nodes_;  ///< by radius, axial ratio, height; odd modes over the height
};

}  // namespace rheocyte

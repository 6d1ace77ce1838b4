// From sampled branches to the rows of a look-up table and its text files.
#pragma once
#include <Eigen/Core>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "table/radius_branches.h"
#include "table/table_interpolation.h"
#include "table/table_spec.h"
#include "table/table_text.h"

namespace rheocyte {

struct TableRow {
  double radius_um = 0;
  BranchPoint state;       ///< stiffness, error of the deformation, whether it is regularised
  Eigen::VectorXd value;   ///< all measures
  double stiffness_error;  ///< relative, at this area and deformation; from the estimated error of the deformation
  bool is_end = false;     ///< the last state of a bare surface
  double at(Measure m) const { return value(int(m)); }
};

/// Rows by radius and, at each radius, by deformation, ascending.
struct LookupTable {
  TableSpec spec;
  std::string version;  ///< of the program, for the headers
  std::vector<RadiusBranches> radii;
  TableInterpolation between;  ///< the branches
  std::vector<TableRow> rows;

  std::string program() const;  ///< with its version
  int regularised_rows() const;
};

/// The row of a state between the samples of a radius.
TableRow row_at(const RadiusBranches& radius, const BranchPoint& state);

/// Whether area and deformation lie in the ranges of the spec.
bool is_inside(const TableSpec& spec, const TableRow& row);

/// Deformations of the rows: rows_per_radius values of equal ratio from the least to the greatest.
std::vector<double> deformation_levels(const TableSpec& spec);

/// Area (um^2) and deformation.
struct LutNode {
  double area_um2, deformation;
};

/// Where a text table has its rows, as far as there is a modulus: on as many columns of equal area as there are radii,
/// by equal steps of the root, at the same deformations in every other of them and halfway between in the rest.
/// Programs put triangles between the points: upright columns keep these well-shaped at small deformations, and
/// staggered ones leave no diagonal to rounding.
std::vector<LutNode> text_places(const TableSpec&);

/// The rows inside the ranges of the spec, and the end of each bare branch. Regularised states are left out unless the
/// spec asks for them. The branches must outlive the table; equal branches in any order give equal tables.
LookupTable make_lookup_table(const TableSpec& spec, std::span<const SampledBranch> branches, std::string_view version);

/// The table in dclab's format, by columns of equal size. For areas they are text_places(), and the stiffness is
/// interpolated between the branches; for volumes they are the radii, staggered in the same way.
std::string lut_text(const LookupTable&, Abscissa);

/// All measures of all rows with the shortest digits that give back the same numbers.
std::string full_table_csv(const LookupTable&);

/// Where the smooth branches of the bare surface end, and why: the curve of the surface instability.
std::string end_of_branch_csv(const LookupTable&);

/// What the bending stiffness that holds the branches beyond their ends changes where the bare surface is stable as
/// well: deformation of both at one radius and stiffness, and the relative change; one line for each held state.
std::string regularisation_csv(const LookupTable&);

/// Comments and metadata that all text files of a table share. `program`: that computed it, with its version.
TableText empty_text(const TableSpec&, const std::string& program, bool has_regularised);
TableText empty_text(const LookupTable&, Abscissa);

struct TableFile {
  std::string name, content;
};

/// All text files: tables and lines by area and by volume, full table, end of the branches, and the spec.
/// Lines have the given levels of stiffness, or those that fit the table.
std::vector<TableFile> table_files(const LookupTable&, std::span<const double> levels = {});

}  // namespace rheocyte

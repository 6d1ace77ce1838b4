// The stiffness of a cell from its area (or volume) and deformation, directly from the branches.
#pragma once
#include <span>
#include <vector>

#include "table/out_of_table.h"
#include "table/radius_branches.h"
#include "table/table_spec.h"
#include "table/table_text.h"

namespace rheocyte {

struct StiffnessAnswer {
  double stiffness;  ///< NaN without an answer
  double error;      ///< estimated, relative: of the solver's states and of the interpolation between the radii
  bool regularised = false;
  OutOfTable reason = OutOfTable::none;
};

/// A query takes from each neighbouring radius the state with the requested deformation and puts a polynomial in
/// ln(size) through up to six of them, whose value stays between those of the two neighbours.
class TableInterpolation {
 public:
  /// The branches must outlive it.
  TableInterpolation(const TableSpec& spec, std::span<const SampledBranch> branches);

  StiffnessAnswer by_area(double area_um2, double deformation) const;
  StiffnessAnswer by_volume(double volume_um3, double deformation) const;

 private:
  class Query;
  TableSpec spec_;
  std::vector<RadiusBranches> radii_;
};

}  // namespace rheocyte

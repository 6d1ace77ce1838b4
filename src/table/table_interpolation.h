// The stiffness of a cell from its area (or volume) and deformation, directly from the branches.
#pragma once
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "table/radius_branches.h"
#include "table/table_spec.h"
#include "table/table_text.h"

namespace rheocyte {

/// Why a table has no answer.
enum class NoAnswer {
  none,        ///< there is one
  invalid,     ///< a number that is not finite or not positive
  too_small,   ///< area or volume below the table's
  too_large,   ///< above
  too_stiff,   ///< deformation below the table's
  too_soft,    ///< above
  unstable,    ///< beyond the end of the smooth branches of a bare surface
  unresolved,  ///< a gap between the branches: states that did not converge
};
/// "too-stiff" etc.; "" for none.
std::string_view name_of(NoAnswer reason);

struct StiffnessAnswer {
  double stiffness;  ///< NaN without an answer
  double error;      ///< estimated, relative: of the solver's states and of the interpolation between the radii
  bool regularised = false;
  NoAnswer reason = NoAnswer::none;
};

/// A query takes from each neighbouring radius the state with the wanted deformation and puts a polynomial in ln(size)
/// through up to six of them, whose value stays between those of the two neighbours.
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

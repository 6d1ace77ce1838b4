// Why a table does not determine the stiffness of a cell.
#pragma once
#include <string_view>

namespace rheocyte {

/// Why a table has no answer.
enum class OutOfTable {
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
std::string_view name_of(OutOfTable reason);

}  // namespace rheocyte

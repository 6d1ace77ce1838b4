// The table by which bulk and cortex of cells are determined, in the liquids of the recordings.
#pragma once
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>

#include "events/options.h"
#include "shelf/modulus_tables.h"
#include "table/combined_interpolation.h"

namespace rheocyte {

/// A combined table, ready for use.
struct ModuliTable {
  /// UserError if cells cannot be interpolated in it.
  explicit ModuliTable(CombinedTable table);
  ModuliTable(const ModuliTable&) = delete;
  ModuliTable& operator=(const ModuliTable&) = delete;

  /// By how much more the law of the square channel leaves of its cells than of neo-Hookean ones.
  double section_error_factor() const;
  /// Of c_3 of its cells.
  double sign_of_asymmetry() const;

  CombinedTable content;
  CombinedInterpolation between;
  ChannelFlow simulated;
};

/// The table of one call. Several threads may use it.
class ModuliTables {
 public:
  /// UserError, also if the table does not have what is to be fitted or is given.
  explicit ModuliTables(const ModuliOptions& options);

  const std::string& name() const { return name_; }  ///< where it was asked for, or its identifier
  const ModuliTable& computed() const { return computed_; }
  /// For cells seen in such a section, in a liquid eta ~ (shear rate)^(n - 1) with this n. In the tube a table of
  /// elongated cells is changed to the liquid (infer/liquid_change.h) where the program has tables of both; the law of
  /// the square section contains the liquid. The table's own virtual cells, by `made_of` (shelf/square_section.h), are
  /// those of its liquid.
  const ModuliTable& seen_in(Section section, double flow_exponent, std::string_view made_of) const;

 private:
  std::string name_;
  ModuliTable computed_;
  mutable std::mutex mutex_;  ///< of all below
  ModulusTables tables_;
  /// By the table of their liquid.
  mutable std::map<const ProportionedCells*, std::unique_ptr<const ModuliTable>> changed_;
};

}  // namespace rheocyte

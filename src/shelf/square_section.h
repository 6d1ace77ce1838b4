// The shipped tables by which cells in a square channel are compared with a table of the tube (docs/theory-extract.md,
// sec. "The square channel").
#pragma once
#include <optional>
#include <string_view>

#include "case/case.h"
#include "shelf/modulus_tables.h"

namespace rheocyte {

/// Whether the cells of a recording are virtual ones of a table. `made_of`: what it says under made_of_key, if
/// anything.
bool are_cells_of(const Case& table, std::string_view made_of);
/// In which they were seen: the requested section; else the table's where they are its virtual cells; else the square.
Section section_seen(std::optional<Section> wanted, std::string_view made_of, const Case& table);
/// What is said where it is the table's.
inline constexpr std::string_view own_cells_text =
    "made by rheocyte synth from cells of the table: the channel is that of the table.";

class SquareSection {
 public:
  /// For a table of the tube whose cells, without their cortex, are those of `tube`. In the section tube nothing is
  /// compared. UserError if the shipped tables are missing.
  SquareSection(Section section, const Case& tube);

  /// The table for a medium with this exponent; null where nothing is compared, or no table has such solids.
  const ModulusMap* table(double flow_exponent) const;

 private:
  std::optional<ModulusTables> tables_;
};

/// What is said where the channel is square, and cells are compared with those of the tube all the same.
inline constexpr std::string_view no_square_text =
    "the channel is square, but no table of it has the solids of this table: the cells are compared with those of the "
    "tube of equal pressure drop, by which moduli are 2 to 9 % too low, those of large cells most.";

}  // namespace rheocyte

#include "extract/moduli_tables.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "case/user_error.h"
#include "infer/liquid_change.h"
#include "infer/square_law.h"
#include "shelf/shipped_tables.h"
#include "shelf/square_section.h"
#include "table/combined_table.h"

namespace rheocyte {

namespace {

bool is_neo_hookean(const Cell& cell) {
  return cell.bulk.law == BulkLaw::neo_hookean &&
         (cell.cortex.law == CortexLaw::neo_hookean || cell.cortex.law == CortexLaw::neo_hookean_reference);
}

}  // namespace

ModuliTable::ModuliTable(CombinedTable table)
    : content(std::move(table)), between(content), simulated(channel_flow_of(content.spec.base)) {}

double ModuliTable::section_error_factor() const {
  return is_neo_hookean(content.spec.base.cell) ? 1 : error_factor_of_other_laws;
}

double ModuliTable::sign_of_asymmetry() const {
  const CellBox& box = between.box();
  return between.at((box.least + box.greatest) / 2).value(first_mode_row + 1);
}

ModuliTables::ModuliTables(const ModuliOptions& options)
    : computed_(read_combined_table(combined_table_or_shipped(options.table))), tables_({}, Section::tube) {
  const TableSpec& spec = computed_.content.spec;
  name_ = options.table.empty() ? spec.identifier : options.table.string();
  if (options.fit_tension && computed_.between.tension_ratios().size() < 2)
    throw UserError(
        fmt::format("rheocyte: --fit-tension needs a table with several tensions (table.tension_ratio); {} has one.",
                    spec.identifier));
  if (options.axial_tension_Pa && *options.axial_tension_Pa != 0 && !computed_.between.is_elongated())
    throw UserError(fmt::format(
        "rheocyte: --axial-tension-Pa needs a table of elongated cells (table.axial_ratio); those of {} have "
        "none.",
        spec.identifier));
}

const ModuliTable& ModuliTables::seen_in(Section section, double flow_exponent, std::string_view made_of) const {
  if (section != Section::tube || !computed_.between.is_elongated() ||
      are_cells_of(computed_.content.spec.base, made_of))
    return computed_;
  const std::scoped_lock lock(mutex_);
  const ProportionedCells* const own = tables_.proportioned(computed_.simulated.exponent).in_liquid;
  const ProportionedCells* const other = tables_.proportioned(flow_exponent).in_liquid;
  const bool can_be_changed =
      own && other && own != other && own->simulated().width_um == computed_.simulated.width_um &&
      std::abs(own->simulated().exponent - computed_.simulated.exponent) < flow_exponent_tolerance;
  if (!can_be_changed) return computed_;
  std::unique_ptr<const ModuliTable>& changed = changed_[other];
  if (!changed)
    changed =
        std::make_unique<const ModuliTable>(LiquidChange(own->table(), other->table()).changed(computed_.content));
  return *changed;
}

}  // namespace rheocyte

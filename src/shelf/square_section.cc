#include "shelf/square_section.h"

#include <cmath>

#include "table/table_metadata.h"
#include "table/table_origin.h"

namespace rheocyte {

bool are_cells_of(const Case& table, std::string_view made_of) {
  return !made_of.empty() && made_of == cells_in_words(model_text(table), table.channel.section);
}

Section section_seen(std::optional<Section> wanted, std::string_view made_of, const Case& table) {
  if (wanted) return *wanted;
  return are_cells_of(table, made_of) ? table.channel.section : Section::square;
}

SquareSection::SquareSection(Section section, const Case& tube) {
  if (section == Section::tube) return;
  switch (tube.cell.bulk.law) {
    case BulkLaw::neo_hookean: tables_.emplace(std::string(), Section::square); break;
    case BulkLaw::linear: tables_.emplace("LE-3D-26"); break;
    case BulkLaw::mooney_rivlin:
    case BulkLaw::fung:
    case BulkLaw::none: break;
  }
}

const ModulusMap* SquareSection::table(double flow_exponent) const {
  if (!tables_) return nullptr;
  const ModulusMap& used = tables_->used(flow_exponent);
  const ModulusMap* const other = tables_->other(flow_exponent);
  const auto distance = [&](const ModulusMap& map) { return std::abs(map.origin().flow.exponent - flow_exponent); };
  return other && distance(*other) < distance(used) ? other : &used;
}

}  // namespace rheocyte

#include "extract/square_section.h"

#include <cmath>

namespace rheocyte {

SquareSection::SquareSection(Section section, const Case& tube) {
  if (section == Section::tube) return;
  switch (tube.cell.bulk.law) {
    case BulkLaw::neo_hookean: tables_.emplace(std::string(), Section::square); break;
    case BulkLaw::linear: tables_.emplace("LE-3D-26"); break;
    case BulkLaw::mooney_rivlin:
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

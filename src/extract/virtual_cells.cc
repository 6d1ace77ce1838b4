#include "extract/virtual_cells.h"

#include <fmt/format.h>

#include <optional>

#include "case/user_error.h"
#include "synth/virtual_recording.h"

namespace rheocyte {

namespace {

std::string_view words_of(std::optional<Elongation> elongation) {
  if (!elongation) return "";
  return *elongation == Elongation::by_tension ? " under an axial tension" : " that are longer than wide at rest";
}

bool has_cells(const ElongatedLiquid* table, const std::string& cells, Elongation elongation) {
  if (!table) return false;
  const ElongatedTable& content = table->solids().table();
  return content.elongation() == elongation && content.origin().cells() == cells;
}

}  // namespace

std::string cells_made_of(const std::string& cells, const Metadata& metadata, const ModulusTables& tables,
                          const ModulusMap& table, double exponent) {
  if (cells.empty()) return {};
  const auto elongation = elongation_of_cells(metadata);
  const std::string made = fmt::format("made by rheocyte synth from {}{}", one_line(cells, 100), words_of(elongation)),
                    used = table.origin().identifier;
  if (elongation && has_cells(tables.elongated(exponent), cells, *elongation))
    return made + "; the table of elongated cells fits.";
  if (!elongation && cells == table.origin().cells()) return fmt::format("{}; the table {} fits.", made, used);
  for (const ModulusMap* const other : tables.others(exponent))
    if (!elongation && cells == other->origin().cells())
      return fmt::format("{}; the table {} fits, the moduli given here are from {}.", made, other->origin().identifier,
                         used);
  return fmt::format("{}; no table that comes with the program has such cells, the moduli given here are from {}.",
                     made, used);
}

}  // namespace rheocyte

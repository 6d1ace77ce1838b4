#include "extract/modulus_tables.h"

#include <cmath>
#include <utility>

#include "case/user_error.h"
#include "extract/find_table.h"
#include "extract/shipped_tables.h"
#include "infer/read_modulus_map.h"

namespace rheocyte {

namespace {

// Of several tables of Newtonian liquids the one that counts.
constexpr std::string_view standard_table = "LE-2D-26";

}  // namespace

const ModulusMap& ModulusTables::Table::ready() const {
  if (!map) map = read_modulus_map(file);
  return *map;
}

ModulusTables::ModulusTables(const std::string& name) : given_(!name.empty()) {
  if (given_) {
    const auto file = find_table(name);
    auto map = read_modulus_map(file);
    const TableOrigin& origin = map->origin();
    tables_.push_back({file, origin.identifier, origin.flow.exponent, std::move(map)});
  }
  if (own())
    for (const auto& [identifier, file] : shipped_tables())
      if (!given_ || identifier != tables_.front().identifier)
        tables_.push_back({file, identifier, read_flow_exponent(file).value_or(1)});
  if (tables_.empty())
    throw UserError(
        "rheocyte: the tables that come with the program are missing; give one with --table, or name their folder in "
        "RHEOCYTE_TABLES.");
}

const ModulusTables::Table* ModulusTables::newtonian() const {
  const Table* found = nullptr;
  for (const auto& table : tables_)
    if (table.flow_exponent == 1 && (!found || table.identifier == standard_table)) found = &table;
  return found;
}

const ModulusTables::Table* ModulusTables::matching(double flow_exponent) const {
  const Table* best = nullptr;
  const auto distance = [&](const Table& table) { return std::abs(table.flow_exponent - flow_exponent); };
  for (const auto& table : tables_)
    if (table.flow_exponent != 1 && distance(table) <= flow_exponent_tolerance &&
        (!best || distance(table) < distance(*best)))
      best = &table;
  return best;
}

ModulusTables::Choice ModulusTables::choose(double flow_exponent) const {
  const Table* const first = &tables_.front();
  if (!own()) return {first, nullptr};
  const Table* const thick = newtonian();
  const Table* const thinning = flow_exponent < 1 ? matching(flow_exponent) : nullptr;
  const Table* const used = given_ ? first : thinning ? thinning : thick ? thick : first;
  const Table* const other = used->flow_exponent == 1 ? thinning : flow_exponent < 1 ? thick : nullptr;
  return {used, other == used ? nullptr : other};
}

const ModulusMap& ModulusTables::used(double flow_exponent) const { return choose(flow_exponent).used->ready(); }

const ModulusMap* ModulusTables::other(double flow_exponent) const {
  const Table* const table = choose(flow_exponent).other;
  return table ? &table->ready() : nullptr;
}

const ShapeMap* ModulusTables::shapes(double flow_exponent) const {
  const ModulusMap& table = used(flow_exponent);
  if (table.shapes()) return table.shapes();
  if (!standard_) {
    const auto shipped = shipped_tables();
    const auto found = shipped.find(std::string(standard_table));
    if (found == shipped.end()) return nullptr;
    standard_ = read_modulus_map(found->second);
  }
  return standard_->shapes();
}

}  // namespace rheocyte

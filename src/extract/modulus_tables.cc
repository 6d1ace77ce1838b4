#include "extract/modulus_tables.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "case/user_error.h"
#include "extract/any_table.h"
#include "extract/find_table.h"
#include "extract/shipped_tables.h"

namespace rheocyte {

namespace {

namespace fs = std::filesystem;

// Of several tables of Newtonian liquids the one that counts.
constexpr std::string_view standard_table = "LE-2D-26";

std::variant<ParityModulus, GridModulus> ready_table(const fs::path& path) {
  AnyTable table = read_any_table(path);
  if (auto* const grid = std::get_if<GridContent>(&table)) return GridModulus(std::move(*grid));
  ParityModulus published(std::get<PublishedTable>(std::move(table)));
  if (published.table().abscissa != Abscissa::area)
    throw UserError(fmt::format("rheocyte: --table {}: holds volumes; only tables of areas are used for recordings.",
                                one_line(path.string(), 200)));
  return published;
}

}  // namespace

ModulusTable::ModulusTable(const fs::path& file) : file_(file), table_(ready_table(file)) {}

const std::string& ModulusTable::identifier() const {
  if (const auto* const grid = std::get_if<GridModulus>(&table_)) return grid->origin().identifier;
  return std::get<ParityModulus>(table_).table().identifier;
}

std::string ModulusTable::description() const {
  if (const auto* const grid = std::get_if<GridModulus>(&table_)) {
    const GridOrigin& o = grid->origin();
    return fmt::format("{} ({}, {} um, {} ul/s, {:.6g} mPa s, by {})", o.identifier, o.model, o.channel_width_um,
                       o.flow_rate_ul_s, o.viscosity_mPas, o.program);
  }
  const PublishedTable& t = std::get<ParityModulus>(table_).table();
  return fmt::format("{} ({} um, {} ul/s, {} mPa s)", t.identifier, t.channel_width_um, t.flow_rate_ul_s,
                     t.viscosity_mPas);
}

double ModulusTable::flow_exponent() const {
  const auto* const grid = std::get_if<GridModulus>(&table_);
  return grid ? grid->origin().flow_exponent : 1;
}

void ModulusTable::estimate(const MeasuringConditions& conditions, const MeasuredEvents& events,
                            const EstimatedModuli& estimates) const {
  if (const auto* const grid = std::get_if<GridModulus>(&table_)) return grid->estimate(conditions, events, estimates);
  const auto& parity = std::get<ParityModulus>(table_);
  parity.moduli(conditions, events, estimates.modulus_kPa);
  std::ranges::fill(estimates.standard_error_kPa, std::numeric_limits<double>::quiet_NaN());
  for (std::size_t i = 0; i < estimates.state.size(); ++i)
    estimates.state[i] = parity.state(conditions, events.size[i], events.deformation[i], estimates.modulus_kPa[i]);
}

ModulusTables::ModulusTables(const std::string& name) : given_(!name.empty()) {
  if (given_) tables_.push_back(std::make_unique<ModulusTable>(find_table(name)));
  if (!given_ || own())
    for (const auto& [identifier, file] : shipped_tables())
      if (!given_ || identifier != tables_.front()->identifier())
        tables_.push_back(std::make_unique<ModulusTable>(file));
  if (tables_.empty())
    throw UserError(
        "rheocyte: the tables that come with the program are missing; give one with --table, or name their folder in "
        "RHEOCYTE_TABLES.");
}

const ModulusTable* ModulusTables::newtonian() const {
  const ModulusTable* found = nullptr;
  for (const auto& table : tables_)
    if (table->flow_exponent() == 1 && (!found || table->identifier() == standard_table)) found = table.get();
  return found;
}

const ModulusTable* ModulusTables::matching(double flow_exponent) const {
  const ModulusTable* best = nullptr;
  const auto distance = [&](const ModulusTable& table) { return std::abs(table.flow_exponent() - flow_exponent); };
  for (const auto& table : tables_)
    if (table->flow_exponent() != 1 && distance(*table) <= flow_exponent_tolerance &&
        (!best || distance(*table) < distance(*best)))
      best = table.get();
  return best;
}

ModulusTables::Choice ModulusTables::choose(double flow_exponent) const {
  const ModulusTable* const first = tables_.front().get();
  if (!own()) return {first};
  const ModulusTable* const thick = newtonian();
  const ModulusTable* const thinning = flow_exponent < 1 ? matching(flow_exponent) : nullptr;
  const ModulusTable* const used = given_ ? first : thinning ? thinning : thick ? thick : first;
  const ModulusTable* const other = used->flow_exponent() == 1 ? thinning : flow_exponent < 1 ? thick : nullptr;
  return {used, other == used ? nullptr : other};
}

}  // namespace rheocyte

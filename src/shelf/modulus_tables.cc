#include "shelf/modulus_tables.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "case/to_path.h"
#include "case/user_error.h"
#include "infer/read_modulus_map.h"
#include "infer/shape_map.h"
#include "shelf/find_table.h"
#include "shelf/shipped_tables.h"
#include "store/read_file.h"
#include "table/combined_table.h"
#include "table/origin_record.h"
#include "table/table_files.h"

namespace rheocyte {

namespace {

// Of several tables of Newtonian liquids the one that counts. In the square channel the surface of linear solids loses
// its stability early, so that their table ends at half the deformation.
constexpr std::string_view standard_tube_table = "LE-2D-26", standard_square_table = "HE-3D-26";

std::string_view standard_table(Section section) {
  return section == Section::square ? standard_square_table : standard_tube_table;
}

struct ProportionedFile {
  std::string_view identifier;
  double flow_exponent;
};
constexpr std::array<ProportionedFile, 4> proportioned_files{
    {{"HL-2D-NH-26", 1}, {"HL-2D-NH-MC049-26", 0.6548}, {"HL-2D-NH-MC059-26", 0.5860}, {"HL-2D-NH-MC083-26", 0.5149}}};

}  // namespace

const ModulusMap& ModulusTables::Table::ready() const {
  if (!map) map = read_modulus_map(file);
  return *map;
}

ModulusTables::ModulusTables(const std::string& name, std::optional<Section> section, std::filesystem::path folder)
    : folder_(std::move(folder)), section_(section.value_or(Section::square)), given_(!name.empty()) {
  if (given_) {
    const auto file = find_table(name, "--table", folder_);
    auto map = read_modulus_map(file);
    const TableOrigin& origin = map->origin();
    section_ = origin.section;
    tables_.push_back({file, origin.identifier, origin.flow.exponent, origin.cells(), std::move(map)});
  }
  if (own()) add_shipped();
  if (tables_.empty() && !section) {
    section_ = Section::tube;
    add_shipped();
  }
  if (tables_.empty())
    throw UserError(fmt::format(
        "rheocyte: the tables{} that come with the program are missing; give one with --table, or name their folder in "
        "RHEOCYTE_TABLES.",
        section_ == Section::square ? " of the square channel" : ""));
}

// Of one section and one solid alone: moduli of the tube and of the square, of one law and another are not mixed.
void ModulusTables::add_shipped() {
  std::optional<std::string> cells;
  if (given_) cells = tables_.front().cells;
  for (const auto& [identifier, file] : shipped_tables(folder_)) {
    if (given_ && identifier == tables_.front().identifier) continue;
    const GridHead head = read_grid_head(file).value_or(GridHead{});
    if (head.section != section_) continue;
    tables_.push_back({file, identifier, head.flow_exponent, cells_in_words(head.model, head.section)});
    if (!given_ && identifier == standard_table(section_)) cells = tables_.back().cells;
  }
  if (cells) std::erase_if(tables_, [&](const Table& table) { return table.cells != *cells; });
}

const ModulusTables::Table* ModulusTables::newtonian() const {
  const Table* found = nullptr;
  for (const auto& table : tables_)
    if (table.flow_exponent == 1 && (!found || table.identifier == standard_table(section_))) found = &table;
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

std::vector<std::filesystem::path> ModulusTables::files() const {
  std::vector<std::filesystem::path> all;
  for (const auto& table : tables_) all.push_back(table.file);
  return all;
}

const ModulusMap& ModulusTables::used(double flow_exponent) const { return choose(flow_exponent).used->ready(); }

const ModulusMap* ModulusTables::other(double flow_exponent) const {
  const Table* const table = choose(flow_exponent).other;
  return table ? &table->ready() : nullptr;
}

std::vector<const ModulusMap*> ModulusTables::others(double flow_exponent) const {
  if (shipped_.empty())
    for (const auto& [identifier, file] : shipped_tables(folder_)) {
      const GridHead head = read_grid_head(file).value_or(GridHead{});
      shipped_.push_back({file, identifier, head.flow_exponent, cells_in_words(head.model, head.section)});
    }
  const auto misfit = [&](const Table& table) {  // of the liquid; above the tolerance nothing fits
    if (table.flow_exponent == 1) return flow_exponent_tolerance;
    return flow_exponent < 1 ? std::abs(table.flow_exponent - flow_exponent) : 1;
  };
  const ShapeMap* const own = shapes(flow_exponent);
  std::map<std::string, const Table*> best;  // by their cells
  for (const Table& table : shipped_) {
    if (misfit(table) > flow_exponent_tolerance || (own && table.cells == own->origin().cells())) continue;
    const Table*& found = best[table.cells];
    if (!found || misfit(table) < misfit(*found)) found = &table;
  }
  std::vector<const ModulusMap*> maps;
  for (const auto& [cells, table] : best) maps.push_back(&table->ready());
  return maps;
}

ModulusTables::Elongated::Elongated(ElongatedContent content, std::unique_ptr<const ModulusMap> same,
                                    std::unique_ptr<const ModulusMap> other)
    : solids(std::move(content)),
      computed(std::move(same)),
      measured(std::move(other)),
      liquid(solids, computed.get(), measured.get()) {}

std::optional<ElongatedFile> elongated_file(double flow_exponent, const std::filesystem::path& folder) {
  const auto misfit = [&](double exponent) { return std::abs(exponent - flow_exponent); };
  std::optional<ElongatedFile> best;
  for (const auto& [identifier, file] : shipped_elongated_tables(folder)) {
    const auto head = grid_head(first_bytes(file, grid_head_bytes).value_or(""));
    if (head && (!best || misfit(head->flow_exponent) < misfit(best->flow_exponent)))
      best = {file, head->flow_exponent};
  }
  return best;
}

ElongatedContent given_elongated_table(const std::string& name) {
  namespace fs = std::filesystem;
  fs::path file = to_path(name);
  std::error_code error;
  const auto shipped = shipped_elongated_tables();
  if (const auto found = shipped.find(name); found != shipped.end()) file = found->second;
  if (const auto tables = table_files(file, "elongated"); tables.size() == 1) file = tables.begin()->second;
  if (!fs::is_regular_file(file, error))
    throw UserError(fmt::format(
        "rheocyte: --table {}: there is no such table of elongated cells; give a file elongated_*.cbor, the folder of "
        "`rheocyte table` with one, or {}.",
        one_line(name, 200), shipped.empty() ? "install those of the program" : shipped.begin()->first));
  return elongated_from_bytes(content_of_file(file, largest_elongated), file.string());
}

const ElongatedLiquid* ModulusTables::elongated(double flow_exponent) const {
  if (section_ == Section::tube && own()) return nullptr;
  auto& found = elongated_[flow_exponent];
  if (found) return &found->liquid;
  const auto best = elongated_file(flow_exponent, folder_);
  if (!best) return nullptr;
  std::unique_ptr<const ModulusMap> computed, measured;
  if (std::abs(best->flow_exponent - flow_exponent) > flow_exponent_tolerance) {
    const ModulusTables square({}, Section::square, folder_);
    computed = read_modulus_map(square.file(best->flow_exponent));
    measured = read_modulus_map(square.file(flow_exponent));
  }
  found = std::make_unique<const Elongated>(
      elongated_from_bytes(content_of_file(best->file, largest_elongated), best->file.string()), std::move(computed),
      std::move(measured));
  return &found->liquid;
}

const ProportionedCells* ModulusTables::proportioned_table(std::string_view identifier) const {
  const auto read = proportioned_.find(identifier);
  if (read != proportioned_.end()) return read->second.get();
  const auto shipped = shipped_combined_tables(folder_);
  const auto found = shipped.find(std::string(identifier));
  if (found == shipped.end()) return nullptr;
  auto cells = std::make_unique<const ProportionedCells>(read_combined_table(found->second));
  return proportioned_.emplace(identifier, std::move(cells)).first->second.get();
}

ProportionedTables ModulusTables::proportioned(double flow_exponent) const {
  const auto misfit = [&](const ProportionedFile& file) { return std::abs(file.flow_exponent - flow_exponent); };
  const auto& nearest = *std::ranges::min_element(proportioned_files, {}, misfit);
  ProportionedTables tables{proportioned_table(nearest.identifier), proportioned_table("HL-2D-NH-26"),
                            proportioned_table("HL-2D-NHR-26")};
  if (!tables.in_liquid) tables.in_liquid = tables.by_current_area;
  return tables;
}

const ShapeMap* ModulusTables::shapes(double flow_exponent) const {
  const ModulusMap& table = used(flow_exponent);
  if (table.shapes()) return table.shapes();
  if (!standard_) {
    const auto shipped = shipped_tables(folder_);
    const auto found = shipped.find(std::string(standard_table(section_)));
    if (found == shipped.end()) return nullptr;
    standard_ = read_modulus_map(found->second);
  }
  return standard_->shapes();
}

}  // namespace rheocyte

#include "table/table_lines.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace rheocyte {

namespace {

constexpr int level_count = 11;
constexpr double fraction_of_stiffest_line = 0.1;  // of the greatest deformation, for the largest cell
constexpr double fraction_of_softest_line = 0.1;   // of the way from the least to the greatest radius

double rounded(double value, int digits) { return std::stod(fmt::format("{:.{}g}", value, digits)); }

// Of the rows at the greatest radius, the first that has the requested fraction of the greatest deformation.
double stiffest_level(const LookupTable& table) {
  const double wanted = fraction_of_stiffest_line * table.spec.max_deformation;
  const TableRow* best = nullptr;
  for (const auto& row : table.rows) {
    const bool is_larger = best && row.radius_um > best->radius_um;
    if (row.at(Measure::deformation) >= wanted && (!best || is_larger)) best = &row;
  }
  return (best ? *best : table.rows.back()).state.stiffness;
}

// Not of the very smallest cells: the line would be a point in the corner of the plane.
double softest_level(const LookupTable& table) {
  const double first = table.rows.front().radius_um, last = table.rows.back().radius_um;
  const double radius = first + fraction_of_softest_line * (last - first);
  const auto beyond = std::ranges::find_if(table.rows, [&](const TableRow& row) { return row.radius_um >= radius; });
  double softest = beyond->state.stiffness;
  for (auto row = beyond; row != table.rows.end() && row->radius_um == beyond->radius_um; ++row)
    softest = std::min(softest, row->state.stiffness);
  return softest;
}

}  // namespace

std::vector<double> line_levels(const LookupTable& table) {
  if (table.rows.empty()) return {};
  const double first = std::pow(stiffest_level(table), -0.5), last = std::pow(softest_level(table), -0.5);
  std::vector<double> levels;
  for (int i = 0; i < level_count; ++i) {
    const double root = first + (last - first) * i / (level_count - 0.5);
    const double level = rounded(std::pow(root, -2), 3);
    if (std::ranges::find(levels, level) == levels.end()) levels.push_back(level);
  }
  std::ranges::sort(levels);
  return levels;
}

std::vector<TableRow> line_at(const LookupTable& table, double stiffness) {
  std::vector<TableRow> line;
  for (const auto& radius : table.radii) {
    const auto state = radius.at_stiffness(stiffness);
    if (!state || (state->regularised && !table.spec.wants_regularised())) continue;
    TableRow row = row_at(radius, *state);
    if (is_inside(table.spec, row)) line.push_back(std::move(row));
  }
  return line;
}

TableText header_of_lines(TableText table) {
  table.comments.insert(table.comments.begin() + 1, "Lines of equal stiffness.");
  auto metadata = nlohmann::ordered_json::object();
  for (const auto& [key, value] : table.metadata.items())
    metadata[key == table_identifier_key ? lines_identifier_key : key] = value;
  table.metadata = std::move(metadata);
  return table;
}

std::string lines_text(const LookupTable& table, std::span<const double> levels, Abscissa abscissa) {
  TableText text = header_of_lines(empty_text(table, abscissa));
  const bool by_area = abscissa == Abscissa::area;
  if (!by_area) text.metadata[lines_identifier_key] = table.spec.identifier + "-volume";
  for (const double level : levels)
    for (const auto& row : line_at(table, level))
      text.rows.push_back(
          {row.at(by_area ? Measure::area_um2 : Measure::volume_um3), row.at(Measure::deformation), level});
  return to_text(text);
}

}  // namespace rheocyte

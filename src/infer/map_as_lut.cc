#include "infer/map_as_lut.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "case/user_error.h"
#include "infer/isoelasticity_lines.h"
#include "store/own_file.h"
#include "table/lookup_table.h"
#include "table/table_lines.h"
#include "table/table_metadata.h"
#include "table/table_text.h"

namespace rheocyte {

namespace {

TableSpec spec_of(const ModulusMap& map) {
  if (!map.is_rheocyte_table())
    throw UserError(fmt::format("{}: is a text table; its grid is needed, grid_*.cbor in the same folder.",
                                map.origin().identifier));
  return parse_table_spec(map.origin().spec, map.origin().identifier, {});
}

struct Answers {
  std::vector<double> modulus_kPa;
  std::vector<ModulusState> states;
};

// In the channel of the table.
Answers answers_at(const ModulusMap& map, std::span<const LutNode> places) {
  std::vector<double> area, deformation;
  for (const auto& place : places) {
    area.push_back(place.area_um2);
    deformation.push_back(place.deformation);
  }
  const ChannelFlow& flow = map.origin().flow;
  const std::vector<double> viscosity(places.size(), flow.viscosity_mPas);
  std::vector<double> error(places.size());
  Answers answers{std::vector<double>(places.size()), std::vector<ModulusState>(places.size())};
  map.estimate({.flow = flow}, {area, deformation, viscosity}, {answers.modulus_kPa, error, answers.states});
  return answers;
}

// The last smooth states, by growing area.
std::vector<LutNode> smooth_ends(const ModulusMap& map, const TableSpec& spec) {
  std::vector<LutNode> ends;
  for (const auto& [area, lowest] : text_places(spec)) {
    if (!ends.empty() && ends.back().area_um2 == area) continue;
    const double end = map.deformations(area).upper;
    if (end > lowest && end < (1 - 1e-6) * spec.max_deformation) ends.push_back({area, end});
  }
  return ends;
}

void add_smooth_ends(TableText& text, std::span<const LutNode> ends) {
  auto area = nlohmann::ordered_json::array(), deformation = area;
  for (const auto& end : ends) {
    area.push_back(end.area_um2);
    deformation.push_back(end.deformation);
  }
  text.metadata["regularised_beyond_area_um2"] = std::move(area);
  text.metadata["regularised_beyond_deformation"] = std::move(deformation);
}

// Of three digits.
std::vector<double> levels_of_lines(const ModulusMap& map) {
  constexpr int count = 11;  // as many as the published files have
  std::vector<double> levels = even_levels(map, count);
  for (double& level : levels) level = std::stod(fmt::format("{:.3g}", level));
  return levels;
}

}  // namespace

TableText map_as_lut(const ModulusMap& map) {
  const TableSpec spec = spec_of(map);
  const auto places = text_places(spec);
  const Answers answers = answers_at(map, places);
  const auto regularised = std::ranges::count(answers.states, ModulusState::regularised);
  TableText text = empty_text(spec, map.origin().program, regularised > 0);
  for (std::size_t i = 0; i < places.size(); ++i)
    if (has_modulus(answers.states[i]))
      text.rows.push_back({places[i].area_um2, places[i].deformation, answers.modulus_kPa[i]});
  const auto ends = smooth_ends(map, spec);
  text.metadata["regularised_rows"] = regularised;
  if (regularised > 0)
    add_smooth_ends(text, ends);
  else
    for (const auto& [area, deformation] : ends)
      text.rows.push_back({area, deformation, map.modulus_kPa(area, deformation)});
  text.metadata["rows"] = text.rows.size();
  return text;
}

TableText lines_of_map(const ModulusMap& map) {
  TableText text = header_of_lines(empty_text(spec_of(map), map.origin().program, false));
  for (const auto& line : isoelasticity_lines(map, levels_of_lines(map)).lines)
    for (const auto& point : line.points) text.rows.push_back({point.x, point.y, line.modulus_kPa});
  return text;
}

void write_texts_of_map(const ModulusMap& map, const std::filesystem::path& rows, const std::filesystem::path& lines) {
  replace_own_file(rows, to_text(map_as_lut(map)), table_mark, Foreign::keep);
  replace_own_file(lines, to_text(lines_of_map(map)), table_mark, Foreign::keep);
}

}  // namespace rheocyte

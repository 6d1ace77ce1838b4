#include "extract/plot_lines.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <utility>

#include "extract/find_table.h"
#include "extract/shipped_tables.h"

namespace rheocyte {

namespace {

using nlohmann::json;

constexpr int number_of_lines = 11;  // as many as the published files have

json as_json(std::span<const PlanePoint> points) {
  json area = json::array(), deformation = json::array();
  for (const auto& point : points) {
    area.push_back(point.x);
    deformation.push_back(point.y);
  }
  return {{"area_um2", std::move(area)}, {"deformation", std::move(deformation)}};
}

double rounded(double value) { return std::stod(fmt::format("{:.2g}", value)); }

}  // namespace

PlotLines::PlotLines(const PlotOptions& options) : options_(options) {
  const bool has_table = !options.table.empty(), has_file = !options.lines.empty();
  if (has_table) given_table_.emplace(find_table(options.table));
  if (has_file) given_lines_ = read_level_lines(options.lines);
  if (has_table || has_file) {
    wanted_ = LinesWanted::yes;
  } else if (!options.no_lines && has_usual_axes(options) && !shipped_tables().empty()) {
    own_tables_.emplace(std::string{});
    wanted_ = options.levels_kPa.empty() ? LinesWanted::if_possible : LinesWanted::yes;
  }
}

const LineSource* PlotLines::source_for(double flow_exponent) {
  if (given_table_) return &*given_table_;
  if (!own_tables_) return nullptr;
  const auto& file = own_tables_->choose(flow_exponent).used->file();
  return &own_sources_.try_emplace(file, file).first->second;
}

// Of the levels that spread over the picture, those next to two digits in the recording's own channel.
LevelLines PlotLines::lines_from(const LineSource& source, const PlotPanel& panel) const {
  const double factor = modulus_factor(source.lines({}), panel.conditions, panel.viscosity_mPas);
  std::vector<double> levels = options_.levels_kPa;
  if (levels.empty())
    for (const double level : source.even_levels(number_of_lines)) levels.push_back(rounded(level * factor));
  for (double& level : levels) level /= factor;
  return source.lines(levels);
}

json PlotLines::for_panel(const PlotPanel& panel) {
  const LineSource* const source = source_for(panel.flow_exponent);
  const LevelLines lines = given_lines_ ? *given_lines_ : lines_from(*source, panel);
  const auto seen = [&](std::span<const PlanePoint> points) {
    const auto pixels = source ? source->pixel_correction() : PixelCorrection::field;
    return as_json(as_measured(points, lines.channel_width_um, panel.conditions, pixels));
  };
  json j{{"lines", json::array()}, {"table", lines.identifier}, {"pixels", panel.conditions.pixel_size_um}};
  const double factor = modulus_factor(lines, panel.conditions, panel.viscosity_mPas);
  for (const auto& line : lines.lines) {
    j["lines"].push_back(seen(line.points));
    j["lines"].back()["young_modulus_kPa"] = line.modulus_kPa * factor;
  }
  if (source) j["support"] = seen(source->support());
  return j;
}

}  // namespace rheocyte

#include "report/plot_lines.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <utility>

#include "case/user_error.h"
#include "shelf/shipped_tables.h"

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
  const bool has_own = !has_file && !options.no_lines && has_usual_axes(options) && !shipped_tables().empty();
  if (has_file) given_lines_ = read_isoelasticity_lines(options.lines);
  if (has_table || has_own) tables_.emplace(options.table, options.section);
  if (has_table || has_file)
    wanted_ = LinesWanted::yes;
  else if (has_own)
    wanted_ = options.levels_kPa.empty() ? LinesWanted::if_possible : LinesWanted::yes;
}

std::string PlotLines::why_none() const {
  const auto is_of_the_plane = [](const std::string& feature) { return feature == "area_um" || feature == "deform"; };
  if (options_.no_lines || has_usual_axes(options_) || !(is_of_the_plane(options_.x) || is_of_the_plane(options_.y)))
    return {};
  return fmt::format(
      "rheocyte: no isoelasticity lines are drawn: they are those of area_um (to the right) and deform (upwards), "
      "not of {} and {}.",
      one_line(options_.x, 60), one_line(options_.y, 60));
}

// Of the levels that spread over the picture, those next to two digits in the recording's own channel.
IsoelasticityLines PlotLines::lines_of(const ModulusMap& map, const PlotPanel& panel) const {
  const double factor = scale_factors(map.origin().flow, panel.conditions.flow).modulus;
  std::vector<double> levels = options_.levels_kPa;
  if (levels.empty())
    for (const double level : even_levels(map, number_of_lines)) levels.push_back(rounded(level * factor));
  for (double& level : levels) level /= factor;
  return isoelasticity_lines(map, levels);
}

json PlotLines::for_panel(const PlotPanel& panel) {
  const auto& conditions = panel.conditions;
  const ModulusMap* const map = tables_ ? &tables_->used(conditions.flow.exponent) : nullptr;
  const IsoelasticityLines lines = given_lines_ ? *given_lines_ : lines_of(*map, panel);
  const auto seen = [&](std::span<const PlanePoint> points) {
    return as_json(as_measured(points, lines.flow, conditions, map));
  };
  json j{{"lines", json::array()}, {"table", lines.identifier}, {"pixels", conditions.pixel_size_um}};
  const double factor = scale_factors(lines.flow, conditions.flow).modulus;
  for (const auto& line : lines.lines) {
    j["lines"].push_back(seen(line.points));
    j["lines"].back()["young_modulus_kPa"] = line.modulus_kPa * factor;
  }
  if (map) j["support"] = seen(support(*map));
  return j;
}

}  // namespace rheocyte

#include "report/dclab_plugin.h"

#include <fmt/format.h>

#include <limits>
#include <nlohmann/json.hpp>
#include <vector>

#include "events/extract_settings.h"
#include "events/plausibility.h"
#include "extract/event_errors.h"
#include "infer/read_modulus_map.h"
#include "measurement/pixel_errors.h"
#include "shelf/modulus_tables.h"
#include "store/base64.h"
#include "store/build_info.h"

namespace rheocyte {

namespace {

using nlohmann::json;

// Single precision keeps seven digits of a modulus at half the size.
std::string packed(const std::vector<double>& values) {
  const std::vector<float> floats(values.begin(), values.end());
  return base64_of(floats.data(), floats.size());
}

json plugin_patch(const GridPatch& patch) {
  return {{"regularised", patch.regularised},
          {"first_column", patch.first_column},
          {"rows", patch.rows},
          {"lower", packed(patch.lower)},
          {"upper", packed(patch.upper)},
          {"log_stiffness", packed(patch.log_stiffness)},
          {"error", packed(patch.error)},
          {"beyond", packed(patch.beyond)}};
}

json plugin_shapes(const ShapeNodes& shapes) {
  return {{"least_log_area", shapes.min_log_area},
          {"column_step", shapes.column_step},
          {"rows", shapes.rows},
          {"lower", packed(shapes.lower)},
          {"upper", packed(shapes.upper)},
          {"inertia_ratio", packed(shapes.inertia_ratio)}};
}

json plugin_table(const GridContent& grid) {
  const ChannelFlow& flow = grid.origin.flow;
  json patches = json::array();
  for (const auto& patch : grid.patches) patches.push_back(plugin_patch(patch));
  json table = {{"channel_width_um", flow.width_um},
                {"flow_rate_ul_per_s", flow.rate_ul_s},
                {"viscosity_mPas", flow.viscosity_mPas},
                {"flow_exponent", flow.exponent},
                {"least_log_area", grid.min_log_area},
                {"column_step", grid.column_step},
                {"columns", grid.columns},
                {"patches", std::move(patches)}};
  if (grid.shapes) table["shapes"] = plugin_shapes(*grid.shapes);
  return table;
}

json plugin_pixel_laws() {
  const PixelErrorLaws laws = pixel_error_laws();
  return {{"area", laws.area},
          {"deformation", laws.deformation},
          {"area_deviation", laws.area_deviation},
          {"deformation_deviation", laws.deformation_deviation},
          {"correlation", laws.correlation},
          {"least_area_deviation", laws.min_area_deviation},
          {"least_deformation_deviation", laws.min_deformation_deviation},
          {"areas_px", {min_fitted_area_px, max_fitted_area_px}},
          {"deformations", {0, max_fitted_deformation}}};
}

json pair_of(const Range& range) { return {range.least, range.greatest}; }

json plugin_limits() {
  const MeasuredRanges ranges = measured_ranges();
  return {{"channel_width_um", pair_of(ranges.channel_width_um)},
          {"flow_rate_ul_s", pair_of(ranges.flow_rate_ul_s)},
          {"pixel_size_um", pair_of(ranges.pixel_size_um)},
          {"temperature_C", {lowest_temperature_C, highest_temperature_C}},
          {"viscosity_mPas", {min_viscosity_mPas, std::numeric_limits<double>::max()}},
          {"flow_exponent_tolerance", flow_exponent_tolerance},
          {"greatest_relative_error", max_relative_standard_error},
          {"greatest_reynolds_number", max_reynolds_number}};
}

}  // namespace

std::string data_of_dclab_plugin() {
  json tables;
  for (const auto& file : ModulusTables("", Section::square).files()) {
    const GridContent grid = read_grid(file);
    tables[grid.origin.identifier] = plugin_table(grid);
  }
  const json inertia = {{"reynolds_number", reynolds_number(buffer_density_kg_per_m3,
                                                            {.width_um = 1, .rate_ul_s = 1, .viscosity_mPas = 1})},
                        {"relative_error", modulus_per_reynolds}};
  const json data = {
      {"tables", tables}, {"pixels", plugin_pixel_laws()}, {"inertia", inertia}, {"limits", plugin_limits()}};
  return fmt::format("\n\ninfo[\"version\"] = \"{}\"\nDATA = r'''\n{}\n'''\n", version, data.dump(0));
}

}  // namespace rheocyte

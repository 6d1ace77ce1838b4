#include "table/table_metadata.h"

#include <fmt/format.h>

#include "case/case_keys.h"
#include "case/channel_flow.h"
#include "case/write_case.h"
#include "table/table_text.h"

namespace rheocyte {

namespace {

using nlohmann::ordered_json;

void add_power_law(ordered_json& metadata, const Case& c) {
  if (c.flow.law != LiquidLaw::power_law) return;
  metadata["fluid_consistency_coefficient"] = c.flow.consistency_Pa_sn.value();
  metadata["fluid_consistency_coefficient_unit"] = "Pa s^n";
  metadata["fluid_flow_behaviour_index"] = c.flow.exponent.value();
  metadata["fluid_flow_behaviour_index_unit"] = "";
}

// The case without what the table sweeps.
ordered_json case_without_swept(const TableSpec& spec) {
  ordered_json json = to_json(spec.base);
  json["cell"].erase("radius_um");
  if (!spec.sweeps_cortex()) json["cell"]["bulk"].erase("young_modulus_kPa");
  if (spec.sweeps_cortex() || spec.is_combined()) json["cell"]["cortex"].erase("modulus_mN_per_m");
  json.erase("numerics");
  return json;
}

}  // namespace

std::string model_text(const Case& c) {
  std::string solid;
  if (c.cell.bulk.law != BulkLaw::none) solid = fmt::format("{} solid", chosen_option(c, "cell.bulk.law"));
  if (c.cell.cortex.law != CortexLaw::none)
    solid += fmt::format("{}{} shell", solid.empty() ? "" : " with ", chosen_option(c, "cell.cortex.law"));
  std::string view;
  if (c.channel.section == Section::square)
    view = c.channel.camera_degree ? fmt::format(" / square channel, seen at {:g} degrees", *c.channel.camera_degree)
                                   : fmt::format(" / square channel, {} view", chosen_option(c, "channel.camera"));
  return fmt::format("{} / {} fluid{}", solid, chosen_option(c, "flow.law"), view);
}

ordered_json table_metadata(const TableSpec& spec, std::string_view program) {
  const Case& c = spec.base;
  const ChannelFlow flow = channel_flow_of(c);
  const bool square = spec.is_square();
  ordered_json metadata{{"authors", "rheocyte"},
                        {"channel_width", flow.width_um},
                        {"channel_width_unit", "um"},
                        {"dimensionality", square ? "3D" : "2Daxis"},
                        {"flow_rate", flow.rate_ul_s},
                        {"flow_rate_unit", "uL/s"},
                        {"fluid_density", c.flow.density_kg_per_m3},
                        {"fluid_density_unit", "kg m^-3"},
                        {"fluid_viscosity", flow.viscosity_mPas},
                        {"fluid_viscosity_unit", "mPa s"}};
  add_power_law(metadata, c);
  metadata[table_identifier_key] = spec.identifier;
  metadata["method"] = "stationary FEM, monolithic Newton, high order";
  metadata["model"] = model_text(c);
  metadata["software"] = program;
  metadata["summary"] = fmt::format("{} stationary states, {}", square ? "3D" : "2D-axis-symmetric", model_text(c));
  metadata["stiffness"] = spec.stiffness_key;
  metadata["stiffness_unit"] = stiffness_unit(spec);
  metadata["accuracy"] = spec.accuracy;
  metadata["bending_beyond_kBT"] = spec.bending_beyond_kBT;
  if (spec.bending_beyond_ratio > 0) metadata["bending_beyond_ratio"] = spec.bending_beyond_ratio;
  metadata["case"] = case_without_swept(spec);
  return metadata;
}

std::string_view stiffness_unit(const TableSpec& spec) { return spec.sweeps_cortex() ? "mN/m" : "kPa"; }

std::string_view stiffness_column(const TableSpec& spec) {
  if (spec.is_combined()) return "stiffness_kPa";
  return spec.sweeps_cortex() ? "cortex_modulus_mN_per_m" : "young_modulus_kPa";
}

}  // namespace rheocyte

#include "table/scale.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "case/scales.h"
#include "case/unit.h"
#include "table/table_metadata.h"

namespace rheocyte {

namespace {

using nlohmann::ordered_json;

// Mokbel et al. 2017, Fig. 6: 10 % at a hundredfold Reynolds number, which is 7.8 with mean speed and tube radius.
constexpr double deformation_per_reynolds = 0.013;
constexpr double negligible_effect = 1e-3;
constexpr double rounding = 1e-9;

bool differ(double a, double b) { return std::abs(a - b) > rounding * std::abs(b); }

double number_at(const ordered_json& metadata, const char* pointer) {
  const ordered_json::json_pointer place(pointer);
  if (!metadata.contains(place)) return 0;
  const auto& value = metadata.at(place);
  return value.is_number() ? value.get<double>() : 0;
}

void multiply(ordered_json& value, double factor) {
  if (value.is_number()) value = value.get<double>() * factor;
  if (value.is_array())
    for (auto& entry : value) multiply(entry, factor);
}

void replace(ordered_json& metadata, const char* pointer, double value) {
  const ordered_json::json_pointer place(pointer);
  if (metadata.contains(place)) metadata.at(place) = value;
}

double exponent_of(const ordered_json& metadata) {
  const double n = number_at(metadata, "/fluid_flow_behaviour_index");
  return n > 0 ? n : 1;
}

bool is_shear_thinning(const ordered_json& metadata) {
  const auto model = metadata.find("model");
  const bool says_so = model != metadata.end() && model->is_string() &&
                       model->get<std::string>().find("non-Newtonian") != std::string::npos;
  return says_so || exponent_of(metadata) != 1;
}

// With the mean speed and the radius of the tube.
double reynolds(double density_kg_per_m3, const ChannelConditions& at) {
  const double R = tube_radius_per_channel_width * at.channel_width_um * 1e-6, Q = at.flow_rate_ul_s * 1e-9;
  return density_kg_per_m3 * Q / (std::numbers::pi * R * at.viscosity_mPas * 1e-3);
}

double inertia_effect(const TableText& table, const ChannelConditions& to) {
  const double density = number_at(table.metadata, "/fluid_density");
  return deformation_per_reynolds * std::abs(reynolds(density, to) - reynolds(density, conditions_of(table)));
}

std::string text_of(const ChannelConditions& at) {
  return fmt::format("{:g} um, {:g} uL/s, {:g} mPa s", at.channel_width_um, at.flow_rate_ul_s, at.viscosity_mPas);
}

// The consistency that gives the wanted effective viscosity at the wall; shear rates go as Q / W^3.
double consistency_factor(const ordered_json& metadata, const ChannelConditions& from, const ChannelConditions& to) {
  const double shear =
      to.flow_rate_ul_s / from.flow_rate_ul_s * std::pow(from.channel_width_um / to.channel_width_um, 3);
  return to.viscosity_mPas / from.viscosity_mPas * std::pow(shear, 1 - exponent_of(metadata));
}

// A length by W' / W, a velocity by Q' / Q (W / W')^2, a stress by the factor of moduli.
double factor_of(const Dimension& dimension, const ChannelConditions& from, const ChannelConditions& to) {
  const double width = to.channel_width_um / from.channel_width_um, rate = to.flow_rate_ul_s / from.flow_rate_ul_s;
  return std::pow(width, dimension.length - 2 * dimension.velocity) * std::pow(rate, dimension.velocity) *
         std::pow(scale_factors(from, to).modulus, dimension.stress);
}

// What a case keeps in another channel; doubts_of_scaling tells the consequence.
bool is_kept(std::string_view key) { return key == "density_kg_per_m3" || key.ends_with("_kBT"); }

// All numbers whose names end with a unit.
void scale_numbers(ordered_json& object, const ChannelConditions& from, const ChannelConditions& to) {
  for (auto& [key, value] : object.items())
    if (value.is_object())
      scale_numbers(value, from, to);
    else if (!is_kept(key))
      multiply(value, factor_of(unit_of(key).dimension, from, to));
}

void scale_metadata(ordered_json& metadata, const ChannelConditions& from, const ChannelConditions& to) {
  scale_numbers(metadata, from, to);
  metadata["channel_width"] = to.channel_width_um;
  metadata["flow_rate"] = to.flow_rate_ul_s;
  metadata["fluid_viscosity"] = to.viscosity_mPas;
  replace(metadata, "/case/flow/rate_ul_per_s", to.flow_rate_ul_s);
  replace(metadata, "/case/flow/viscosity_mPas", to.viscosity_mPas);
  for (const char* consistency : {"/fluid_consistency_coefficient", "/case/flow/consistency_Pa_sn"})
    if (const ordered_json::json_pointer place(consistency); metadata.contains(place))
      multiply(metadata.at(place), consistency_factor(metadata, from, to));
  metadata["scaled_from"] = {{"channel_width", from.channel_width_um},
                             {"flow_rate", from.flow_rate_ul_s},
                             {"fluid_viscosity", from.viscosity_mPas}};
}

bool is_of_cortex(const ordered_json& metadata) {
  const auto key = metadata.find("stiffness");
  return key != metadata.end() && *key == "cell.cortex.modulus_mN_per_m";
}

}  // namespace

ChannelConditions conditions_of(const TableText& table) {
  const auto value = [&](const char* key) { return table.metadata.at(key).get<double>(); };
  return {value("channel_width"), value("flow_rate"), value("fluid_viscosity")};
}

ScaleFactors scale_factors(const ChannelConditions& from, const ChannelConditions& to) {
  const double width = to.channel_width_um / from.channel_width_um;
  const double force =
      to.flow_rate_ul_s * to.viscosity_mPas / (from.flow_rate_ul_s * from.viscosity_mPas);  // eta Q, in pN m/s
  return {force / (width * width * width), force / (width * width), width * width, width * width * width};
}

std::vector<std::string> doubts_of_scaling(const TableText& table, const ChannelConditions& to) {
  const auto from = conditions_of(table);
  const bool same_force = !differ(from.flow_rate_ul_s * from.viscosity_mPas, to.flow_rate_ul_s * to.viscosity_mPas);
  const bool same = same_force && !differ(from.channel_width_um, to.channel_width_um) &&
                    !differ(from.flow_rate_ul_s, to.flow_rate_ul_s);
  std::vector<std::string> doubts;
  if (same) return doubts;
  if (is_shear_thinning(table.metadata))
    doubts.push_back(
        "its liquid is shear-thinning, and the scaling holds only for liquids of the same exponent with the viscosity "
        "at the wall");
  if (const double effect = inertia_effect(table, to); effect > negligible_effect)
    doubts.push_back(fmt::format("inertia changes the deformation by about {:.1g} %", 100 * effect));
  const bool bending = number_at(table.metadata, "/case/cell/cortex/bending_kBT") > 0 ||
                       number_at(table.metadata, "/regularised_rows") > 0;
  if (bending && !same_force)
    doubts.push_back(fmt::format("its bending stiffness becomes that of cells {:.3g} times as stiff against bending",
                                 to.flow_rate_ul_s * to.viscosity_mPas / (from.flow_rate_ul_s * from.viscosity_mPas)));
  return doubts;
}

TableText scaled(const TableText& table, const ChannelConditions& to, std::string_view version) {
  const auto from = conditions_of(table);
  const auto factor = scale_factors(from, to);
  TableText result = table;
  std::vector<std::string> comments{
      fmt::format("{}{}: scaled from {} to {}.", table_mark.substr(2), version, text_of(from), text_of(to))};
  for (const auto& doubt : doubts_of_scaling(table, to)) comments.push_back(fmt::format("Not exact: {}.", doubt));
  if (const double effect = inertia_effect(table, to); effect > 0 && effect <= negligible_effect)
    comments.push_back(fmt::format("Inertia changes the deformation by about {:.1g} %.", 100 * effect));
  comments.emplace_back("What the table said before:");
  comments.emplace_back();
  result.comments.insert(result.comments.begin(), comments.begin(), comments.end());
  scale_metadata(result.metadata, from, to);
  const bool by_area = table.abscissa == Abscissa::area;
  const double modulus = is_of_cortex(table.metadata) ? factor.cortex_modulus : factor.modulus;
  for (auto& row : result.rows) {
    row[0] *= by_area ? factor.area : factor.volume;
    row[2] *= modulus;
  }
  return result;
}

}  // namespace rheocyte

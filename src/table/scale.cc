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

double inertia_effect(const TableText& table, const ChannelFlow& to) {
  const double density = number_at(table.metadata, "/fluid_density");
  return deformation_per_reynolds *
         std::abs(reynolds_number(density, to) - reynolds_number(density, channel_flow_of(table)));
}

std::string text_of(const ChannelFlow& at) {
  return fmt::format("{:g} um, {:g} uL/s, {:g} mPa s", at.width_um, at.rate_ul_s, at.viscosity_mPas);
}

// The consistency that gives the requested effective viscosity at the wall; shear rates go as Q / W^3.
double consistency_factor(double exponent, const ChannelFlow& from, const ChannelFlow& to) {
  const double shear = to.rate_ul_s / from.rate_ul_s / scale_factors(from, to).volume;
  return to.viscosity_mPas / from.viscosity_mPas * std::pow(shear, 1 - exponent);
}

// A length by W' / W, a velocity by Q' / Q (W / W')^2, a stress by the factor of moduli.
double factor_of(const Dimension& dimension, const ChannelFlow& from, const ChannelFlow& to) {
  const ScaleFactors factor = scale_factors(from, to);
  const double rate = to.rate_ul_s / from.rate_ul_s;
  return std::pow(factor.length, dimension.length - 2 * dimension.velocity) * std::pow(rate, dimension.velocity) *
         std::pow(factor.modulus, dimension.stress);
}

// What a case keeps in another channel; doubts_of_scaling gives the consequence.
bool is_kept(std::string_view key) { return key == "density_kg_per_m3" || key.ends_with("_kBT"); }

// All numbers whose names end with a unit.
void scale_numbers(ordered_json& object, const ChannelFlow& from, const ChannelFlow& to) {
  for (auto& [key, value] : object.items())
    if (value.is_object())
      scale_numbers(value, from, to);
    else if (!is_kept(key))
      multiply(value, factor_of(unit_of(key).dimension, from, to));
}

void scale_metadata(ordered_json& metadata, const ChannelFlow& from, const ChannelFlow& to) {
  scale_numbers(metadata, from, to);
  metadata["channel_width"] = to.width_um;
  metadata["flow_rate"] = to.rate_ul_s;
  metadata["fluid_viscosity"] = to.viscosity_mPas;
  replace(metadata, "/case/flow/rate_ul_per_s", to.rate_ul_s);
  replace(metadata, "/case/flow/viscosity_mPas", to.viscosity_mPas);
  for (const char* consistency : {"/fluid_consistency_coefficient", "/case/flow/consistency_Pa_sn"})
    if (const ordered_json::json_pointer place(consistency); metadata.contains(place))
      multiply(metadata.at(place), consistency_factor(exponent_of(metadata), from, to));
  metadata["scaled_from"] = {
      {"channel_width", from.width_um}, {"flow_rate", from.rate_ul_s}, {"fluid_viscosity", from.viscosity_mPas}};
}

bool is_of_cortex(const ordered_json& metadata) {
  const auto key = metadata.find("stiffness");
  return key != metadata.end() && *key == "cell.cortex.modulus_mN_per_m";
}

}  // namespace

ChannelFlow channel_flow_of(const TableText& table) {
  return {.width_um = table.metadata.at("channel_width"),
          .rate_ul_s = table.metadata.at("flow_rate"),
          .viscosity_mPas = table.metadata.at("fluid_viscosity"),
          .exponent = exponent_of(table.metadata)};
}

std::vector<std::string> doubts_of_scaling(const TableText& table, const ChannelFlow& to) {
  const auto from = channel_flow_of(table);
  const double load = scale_factors(from, to).load;
  const bool same_force = !differ(load, 1);
  const bool same = same_force && !differ(from.width_um, to.width_um) && !differ(from.rate_ul_s, to.rate_ul_s);
  std::vector<std::string> doubts;
  if (same) return doubts;
  if (is_shear_thinning(table.metadata))
    doubts.push_back(
        "its liquid is shear-thinning, and the scaling holds only for liquids of the same exponent with the viscosity "
        "at the wall");
  if (const double effect = inertia_effect(table, to); effect > negligible_effect)
    doubts.push_back(fmt::format("inertia changes the deformation by about {:.1g} %", 100 * effect));
  // A fraction of the modulus times a power of the radius stays what it is.
  const bool is_fraction = number_at(table.metadata, "/bending_beyond_ratio") > 0;
  const bool bending = number_at(table.metadata, "/case/cell/cortex/bending_kBT") > 0 ||
                       (number_at(table.metadata, "/regularised_rows") > 0 && !is_fraction);
  if (bending && !same_force)
    doubts.push_back(
        fmt::format("its bending stiffness becomes that of cells {:.3g} times as stiff against bending", load));
  return doubts;
}

TableText scaled(const TableText& table, const ChannelFlow& to, std::string_view version) {
  const auto from = channel_flow_of(table);
  const auto factor = scale_factors(from, to);
  TableText result = table;
  std::vector<std::string> comments{
      fmt::format("{}{}: scaled from {} to {}.", table_mark.substr(2), version, text_of(from), text_of(to))};
  for (const auto& doubt : doubts_of_scaling(table, to)) comments.push_back(fmt::format("Not exact: {}.", doubt));
  if (const double effect = inertia_effect(table, to); effect > 0 && effect <= negligible_effect)
    comments.push_back(fmt::format("Inertia changes the deformation by about {:.1g} %.", 100 * effect));
  comments.emplace_back("Header of the original table:");
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

#include "table/table_spec.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <numbers>
#include <utility>

#include "case/case_keys.h"
#include "case/case_text.h"
#include "case/key_reading.h"
#include "case/nearest_name.h"
#include "case/read_case.h"
#include "case/scales.h"
#include "case/user_error.h"
#include "case/write_keys.h"
#include "numeric/fingerprint.h"
#include "table/table_keys.h"

namespace rheocyte {

namespace {

constexpr std::string_view radius_key = "cell.radius_um", accuracy_key = "numerics.accuracy", drive_key = "flow.drive",
                           bulk_law_key = "cell.bulk.law", cortex_law_key = "cell.cortex.law";
constexpr std::string_view bulk_modulus_key = "cell.bulk.young_modulus_kPa",
                           cortex_modulus_key = "cell.cortex.modulus_mN_per_m",
                           tension_key = "cell.cortex.tension_mN_per_m", ratio_key = "cell.cortex.tension_ratio",
                           bending_key = "cell.cortex.bending_kBT", beyond_key = "table.bending_beyond_kBT",
                           beyond_ratio_key = "table.bending_beyond_ratio",
                           from_margin_key = "table.bending_from_margin", channel_section_key = "channel.section";
constexpr std::string_view axial_key = "table.axial_ratio", elongated_by_key = "table.elongated_by";
constexpr std::array<std::string_view, 3> stiffness_keys{bulk_modulus_key, cortex_modulus_key, combined_stiffness};
// Those that programs know already; they must not appear on other numbers.
constexpr std::array<std::string_view, 4> foreign_identifiers{"LE-2D-FEM-19", "HE-2D-FEM-22", "HE-3D-FEM-22",
                                                              "LE-2D-ana-18"};
constexpr std::size_t longest_identifier = 60;

std::string quoted_list(std::span<const std::string_view> words) {
  std::string text;
  for (const auto word : words) text += fmt::format("{}\"{}\"", text.empty() ? "" : " or ", word);
  return text;
}

bool has_bulk(const KeyReading& keys) { return keys.chosen(bulk_law_key) != "none"; }
bool has_cortex(const KeyReading& keys) { return keys.chosen(cortex_law_key) != "none"; }

// Bulk and cortex, all moduli along the sweep, tension as a fraction of the cortex.
void check_combined(TableSpec& spec, const KeyReading& keys) {
  constexpr std::string_view fractions = "table.cortex_fraction";
  if (keys.has("table.stiffness") && !spec.is_combined())
    keys.refuse_stated("table.stiffness",
                       fmt::format("does not go with {}; write \"{}\" or leave it out", fractions, combined_stiffness));
  spec.stiffness_key = combined_stiffness;
  if (!has_bulk(keys) || !has_cortex(keys))
    keys.refuse(fractions, fmt::format("{} needs a law of the bulk and one of the cortex.", fractions));
  if (spec.cortex_fractions.size() < (spec.is_elongated() ? 1 : 2))
    keys.refuse(fractions, fmt::format("{} needs at least two fractions, such as [0, 0.5, 1]; with table.axial_ratio "
                                       "one.",
                                       fractions));
  if (keys.has(tension_key))
    keys.refuse_stated(tension_key, fmt::format("does not go with {}; give {} instead", fractions, ratio_key));
  const auto exclude = [&](std::string_view one, std::string_view other) {
    if (keys.has(one) && keys.has(other))
      keys.refuse_stated(one, fmt::format("and {} exclude each other; give one of them", other));
  };
  exclude(ratio_key, "table.tension_ratio");
  if (spec.bending_ratio > 0) exclude(bending_key, "table.bending_ratio");
  for (const auto& [key, value] :
       {std::pair(beyond_key, spec.bending_beyond_kBT), std::pair(beyond_ratio_key, spec.bending_beyond_ratio)})
    if (value > 0)
      keys.refuse(key, fmt::format("{} has no effect on combined cells; give table.bending_ratio or {}, which all "
                                   "have.",
                                   key, bending_key));
  const auto* ratio = keys.value(ratio_key);
  if (spec.tension_ratios.empty()) spec.tension_ratios = {ratio ? std::get<double>(*ratio) : 0};
}

void choose_stiffness(TableSpec& spec, const KeyReading& keys) {
  constexpr std::string_view key = "table.stiffness";
  const bool bulk = has_bulk(keys), cortex = has_cortex(keys);
  if (keys.has("table.cortex_fraction")) return check_combined(spec, keys);
  if (!keys.has(key)) {
    spec.stiffness_key = stiffness_keys[bulk ? 0 : 1];
    return;
  }
  const auto found = std::ranges::find(stiffness_keys, spec.stiffness_key);
  if (found == stiffness_keys.end()) {
    const auto hint = did_you_mean(spec.stiffness_key, stiffness_keys);
    keys.refuse(key, fmt::format("{} cannot be swept; it can be {}{}", keys.stated(key), quoted_list(stiffness_keys),
                                 hint.empty() ? "." : hint));
  }
  if (spec.is_combined())
    keys.refuse(key, "table.stiffness = \"combined\" needs table.cortex_fraction, such as [0, 0.5, 1].");
  if (found == stiffness_keys.begin() ? !bulk : !cortex)
    keys.refuse_stated(key,
                       fmt::format("cannot be swept, because {} is \"none\"; choose a law, or sweep the other modulus",
                                   found == stiffness_keys.begin() ? bulk_law_key : cortex_law_key));
}

// Keys of a case that the sweep gives.
std::vector<std::string_view> swept_keys(const TableSpec& spec) {
  std::vector<std::string_view> keys{radius_key, accuracy_key};
  if (!spec.is_combined()) keys.push_back(spec.stiffness_key);
  if (spec.is_combined()) keys.insert(keys.end(), {bulk_modulus_key, cortex_modulus_key});
  return keys;
}

// What the sweep itself gives must not be given as well.
void refuse_swept_keys(const TableSpec& spec, const KeyReading& keys) {
  const auto refuse = [&](std::string_view key, const std::string& reason) {
    if (keys.has(key)) keys.refuse_stated(key, reason);
  };
  refuse(radius_key, "must not be given, because a table sweeps it; choose table.min_area_um2 and table.max_area_um2");
  refuse(accuracy_key, "has no effect on a table; choose table.accuracy");
  for (const auto key : swept_keys(spec))
    refuse(key,
           "must not be given, because a table sweeps it; choose table.min_deformation and "
           "table.max_deformation");
  refuse("channel.camera_degree", "is not for tables; choose channel.camera");
  const auto* bending = keys.value(bending_key);
  if (keys.chosen(channel_section_key) == "square" && bending && std::get<double>(*bending) > 0)
    refuse(bending_key, fmt::format("is not for tables of square channels, whose small cells it would stabilise far "
                                    "more than large ones; choose {}",
                                    beyond_ratio_key));
  for (const auto key : {drive_key, std::string_view("flow.pressure_drop_Pa")})
    refuse(key, "must not be given, because a table is that of one flow rate; choose flow.rate_ul_per_s");
}

void check_identifier(const std::string& identifier, const KeyReading& keys) {
  constexpr std::string_view key = "table.identifier";
  const auto is_plain = [](unsigned char c) { return std::isalnum(c) || c == '-'; };
  if (identifier.empty() || identifier.size() > longest_identifier || !std::ranges::all_of(identifier, is_plain))
    keys.refuse_stated(
        key, fmt::format("is not a name of a table; take 1 to {} letters, digits and hyphens", longest_identifier));
  for (const auto foreign : foreign_identifiers)
    if (edit_distance(identifier, foreign) == 0)
      keys.refuse_stated(key, "is the name of a published table of others; choose another one");
}

void check_order(const TableSpec& spec, const KeyReading& keys) {
  const auto check = [&](double least, double greatest, std::string_view what) {
    if (least < greatest) return;
    const auto min_key = fmt::format("table.min_{}", what), max_key = fmt::format("table.max_{}", what);
    keys.refuse(
        keys.has(min_key) ? min_key : max_key,
        fmt::format("{} = {:g} is not below {} = {:g}; the table would be empty.", min_key, least, max_key, greatest));
  };
  check(spec.min_area_um2, spec.max_area_um2, "area_um2");
  check(spec.min_deformation, spec.max_deformation, "deformation");
}

double sphere_area(double radius) { return std::numbers::pi * radius * radius; }

void check_areas(const TableSpec& spec, const KeyReading& keys) {
  const double R = unit_length_um(spec.base);
  const Range possible{sphere_area(min_radius_ratio * R), sphere_area(max_radius_ratio * R)};
  for (const auto& [key, area] :
       {std::pair("table.min_area_um2", spec.min_area_um2), std::pair("table.max_area_um2", spec.max_area_um2)})
    if (!possible.contains(area))
      keys.refuse(key,
                  fmt::format("{} = {:g} um2 is an area that no cell of this channel can have; cells of {} .. {} of "
                              "the {} {:.6g} um have {:.3g} .. {:.4g} um2.",
                              key, area, min_radius_ratio, max_radius_ratio,
                              spec.is_square() ? "half width" : "tube radius", R, possible.least, possible.greatest));
}

void check_bending(const TableSpec& spec, const KeyReading& keys) {
  if (spec.bending_from_margin > 0 && spec.bending_beyond_ratio == 0)
    keys.refuse_stated(
        from_margin_key,
        fmt::format("has no effect without {}; give that too, such as 3e-5, or leave it out", beyond_ratio_key));
  if (spec.bending_beyond_kBT == 0) return;
  if (spec.is_square())
    keys.refuse_stated(beyond_key, fmt::format("is for tubes, because a polynomial over the radius needs cells that "
                                               "are alike; give {}, such as 3e-5, or leave it out",
                                               beyond_ratio_key));
  if (const double own = spec.base.cell.cortex.bending_kBT; spec.bending_beyond_kBT <= own)
    keys.refuse(beyond_key,
                fmt::format("{} = {:g} does not exceed {} = {:g}, which all states have; raise it or leave it out.",
                            beyond_key, spec.bending_beyond_kBT, bending_key, own));
}

/// Solids in the square channel, or cells with bulk and cortex.
void check_elongation(const TableSpec& spec, const KeyReading& keys) {
  if (!spec.is_elongated()) return;
  if (spec.base.cell.bulk.law == BulkLaw::fung)
    keys.refuse(axial_key, fmt::format("{} is not for cell.bulk.law = \"fung\", because elongations are expressed as "
                                       "those of a neo-Hookean solid; choose another law or leave it out.",
                                       axial_key));
  if (!spec.is_combined() && (!spec.is_square() || spec.sweeps_cortex()))
    keys.refuse(axial_key, fmt::format("{} is for solids in the square channel (channel.section = \"square\"), and for "
                                       "cells with bulk and cortex (table.cortex_fraction).",
                                       axial_key));
  if (spec.axial_ratios.size() < 4 || !std::ranges::binary_search(spec.axial_ratios, 0.0))
    keys.refuse(
        axial_key,
        fmt::format("{} needs at least four numbers, 0 among them, such as [-0.1, 0, 0.15, 0.3, 0.45].", axial_key));
  if (spec.elongation == Elongation::by_rest_shape && spec.is_combined())
    keys.refuse_stated(elongated_by_key, "is for solids; cells with bulk and cortex are elongated by a tension");
  if (spec.bending_beyond_ratio > 0)
    keys.refuse_stated(beyond_ratio_key, fmt::format("does not go with {}; leave it out", axial_key));
}

void check_section(const Case& c, const KeyReading& keys) {
  if (c.channel.section == Section::rectangle)
    keys.refuse_stated(channel_section_key, "is not for tables, which are those of tubes and of square channels");
}

void check_liquid(const Case& c, const KeyReading& keys) {
  if (is_power_law(c.flow.law)) return;
  keys.refuse("flow.law",
              "a table needs a liquid whose flows scale between flow rates; choose \"newtonian\" or "
              "\"power-law\".");
}

// Any cell of the sweep, so that the base is a complete case.
SweepPoint middle_of(const TableSpec& spec) {
  SweepPoint place{unit_length_um(spec.base) / 2};
  if (spec.is_combined()) place = {place.radius_um, 0.5, spec.tension_ratios.front()};
  return place;
}

}  // namespace

TableSpec parse_table_spec(std::string_view text, const std::string& name, std::span<const std::string> settings) {
  KeyReading keys(key_list(case_keys(), table_keys()), given_keys(text, name, settings, specification("table")), name,
                  "table");
  TableSpec spec;
  keys.fill(spec, table_keys());  // what is given; the sweep decides what of the case is not to be given
  choose_stiffness(spec, keys);
  refuse_swept_keys(spec, keys);
  spec.base = complete_case(keys, swept_keys(spec));
  check_section(spec.base, keys);
  check_liquid(spec.base, keys);
  keys.fill(spec, table_keys());
  check_identifier(spec.identifier, keys);
  check_order(spec, keys);
  spec.base = case_at(spec, middle_of(spec), 1);
  check_areas(spec, keys);
  check_bending(spec, keys);
  check_elongation(spec, keys);
  return spec;
}

TableSpec read_table_spec(const std::filesystem::path& file, std::span<const std::string> settings) {
  return parse_table_spec(read_case_text(file, specification("table")), file.string(), settings);
}

std::string to_toml(const TableSpec& spec) {
  auto left_out = swept_keys(spec);
  left_out.push_back(drive_key);
  if (spec.is_combined()) left_out.push_back(ratio_key);
  // What only combined cells have is written where it is given.
  left_out.push_back(spec.bending_ratio > 0 ? bending_key : "table.bending_ratio");
  if (spec.bending_beyond_ratio == 0) left_out.push_back(beyond_ratio_key);
  if (spec.bending_from_margin == 0) left_out.push_back(from_margin_key);
  if (spec.elongation == Elongation::by_tension) left_out.push_back(elongated_by_key);
  if (spec.max_deformation_raw == TableSpec{}.max_deformation_raw) left_out.emplace_back("table.max_deformation_raw");
  return to_toml(values_of(spec.base, case_keys(), spec, table_keys()), left_out);
}

std::string spec_hash(const TableSpec& spec) { return fingerprint(to_toml(spec)); }

}  // namespace rheocyte

#include "table/table_spec.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

#include "case/case_text.h"
#include "case/nearest_name.h"
#include "case/parameters.h"
#include "case/read_case.h"
#include "case/scales.h"
#include "case/user_error.h"
#include "case/write_case.h"
#include "table/table_keys.h"

namespace rheocyte {

namespace {

constexpr std::string_view radius_key = "cell.radius_um", accuracy_key = "numerics.accuracy", drive_key = "flow.drive",
                           bulk_law_key = "cell.bulk.law", cortex_law_key = "cell.cortex.law";
constexpr std::string_view bulk_modulus_key = "cell.bulk.young_modulus_kPa",
                           cortex_modulus_key = "cell.cortex.modulus_mN_per_m",
                           tension_key = "cell.cortex.tension_mN_per_m", ratio_key = "cell.cortex.tension_ratio",
                           bending_key = "cell.cortex.bending_kBT";
constexpr std::array<std::string_view, 3> stiffness_keys{bulk_modulus_key, cortex_modulus_key, combined_stiffness};
// Those that programs know already; they must not appear on other numbers.
constexpr std::array<std::string_view, 4> foreign_identifiers{"LE-2D-FEM-19", "HE-2D-FEM-22", "HE-3D-FEM-22",
                                                              "LE-2D-ana-18"};
constexpr std::size_t longest_identifier = 60;
constexpr std::array<std::string_view, 3> keys_of_combined{"table.tension_ratio", "table.bending_ratio",
                                                           "table.greatest_deformation_raw"};

using TableKeys = std::map<std::string_view, GivenKey>;

[[noreturn]] void refuse(const GivenKey& given, const std::string& reason) {
  throw UserError(fmt::format("{}: {}", given.where, reason));
}

std::string stated(const GivenKey& given) { return fmt::format("{} = {}", one_line(given.key, 80), value_text(given)); }

bool belongs_to_table(const GivenKey& given) { return given.key == "table" || given.key.starts_with("table."); }

std::string quoted_list(std::span<const std::string_view> words) {
  std::string text;
  for (const auto word : words) text += fmt::format("{}\"{}\"", text.empty() ? "" : " or ", word);
  return text;
}

// A key that neither a case nor the section [table] has, but that resembles one of the latter.
void check_misspelt_table_key(const GivenKey& given) {
  if (find_parameter(given.key)) return;
  std::vector<std::string_view> known;
  for (const auto& parameter : parameters()) known.push_back(parameter.key);
  for (const auto& key : table_keys()) known.push_back(key.key);
  const auto nearest = nearest_name(given.key, known);
  if (nearest && find_table_key(*nearest))
    refuse(given, fmt::format("unknown key {}, did you mean {}?", stated(given), *nearest));
}

TableKeys take_table_keys(std::vector<GivenKey>& keys) {
  TableKeys taken;
  std::vector<GivenKey> others;
  for (auto& given : keys) {
    if (!belongs_to_table(given)) {
      check_misspelt_table_key(given);
      others.push_back(std::move(given));
      continue;
    }
    if (given.key == "table") continue;  // an empty section, or a value that the identifier's absence will show
    const TableKey* key = find_table_key(given.key);
    if (!key) {
      std::vector<std::string_view> known;
      for (const auto& entry : table_keys()) known.push_back(entry.key);
      const auto hint = did_you_mean(given.key, known);
      refuse(given, fmt::format("unknown key {}{}", stated(given),
                                hint.empty() ? "; docs/tables.md lists the keys of [table]." : hint));
    }
    taken.insert_or_assign(key->key, std::move(given));
  }
  keys = std::move(others);
  return taken;
}

std::string range_text(const TableKey& key, const Range& range) {
  return fmt::format("{:g} .. {:g}{}{} ({})", range.least, range.greatest, key.unit.empty() ? "" : " ", key.unit,
                     key.sentence);
}

void set_list(TableSpec& spec, const TableKey& key, const TableList& list, const GivenKey& given) {
  const auto* numbers = std::get_if<std::vector<double>>(&given.value);
  const auto allowed = range_text(key, list.range);
  if (!numbers)
    refuse(given,
           fmt::format("{} is not a list of numbers such as [0, 0.5, 1]; they can be {}.", stated(given), allowed));
  for (const double number : *numbers)
    if (!list.range.contains(number))
      refuse(given, fmt::format("{:g} in {} is outside its range {}.", number, key.key, allowed));
  if (std::ranges::adjacent_find(*numbers, std::greater_equal<>()) != numbers->end())
    refuse(given, fmt::format("the numbers of {} do not rise; sort them and leave out what stands twice.", key.key));
  spec.*(list.field) = *numbers;
}

void set_value(TableSpec& spec, const TableKey& key, const GivenKey& given) {
  if (const auto* list = std::get_if<TableList>(&key.value)) return set_list(spec, key, *list, given);
  if (const auto* word = std::get_if<TableWord>(&key.value)) {
    const auto* text = std::get_if<std::string>(&given.value);
    if (!text) refuse(given, fmt::format("{} must be a word ({}).", stated(given), key.sentence));
    spec.*(word->field) = *text;
    return;
  }
  const auto& number = std::get<TableNumber>(key.value);
  const auto* value = std::get_if<double>(&given.value);
  const auto allowed = range_text(key, number.range);
  if (!value) refuse(given, fmt::format("{} is not a number; it can be {}.", stated(given), allowed));
  if (!number.range.contains(*value)) refuse(given, fmt::format("{} is outside its range {}.", stated(given), allowed));
  if (number.is_whole && *value != std::floor(*value))
    refuse(given, fmt::format("{} is not a whole number; it can be {}.", stated(given), allowed));
  number.set(spec, *value);
}

// The last one counts: settings stand behind the file.
const GivenKey* last_of(const std::vector<GivenKey>& keys, std::string_view key) {
  const auto found = std::find_if(keys.rbegin(), keys.rend(), [&](const GivenKey& given) { return given.key == key; });
  return found == keys.rend() ? nullptr : &*found;
}

bool is_none(const GivenKey* law) {
  const auto* word = law ? std::get_if<std::string>(&law->value) : nullptr;
  return word && *word == "none";
}

bool has_bulk(const std::vector<GivenKey>& keys) { return !is_none(last_of(keys, bulk_law_key)); }

bool has_cortex(const std::vector<GivenKey>& keys) {
  const GivenKey* law = last_of(keys, cortex_law_key);
  return law && !is_none(law);
}

// Bulk and cortex, all moduli along the sweep, tension as a share of the cortex.
void check_combined(TableSpec& spec, const std::vector<GivenKey>& keys, const TableKeys& given) {
  const GivenKey& shares = given.at("table.cortex_share");
  if (given.contains("table.stiffness") && !spec.is_combined())
    refuse(given.at("table.stiffness"),
           fmt::format("{} does not go with table.cortex_share; write \"{}\" or leave it out.",
                       stated(given.at("table.stiffness")), combined_stiffness));
  spec.stiffness_key = combined_stiffness;
  if (!has_bulk(keys) || !has_cortex(keys))
    refuse(shares, "table.cortex_share needs a law of the bulk and one of the cortex.");
  if (spec.cortex_shares.size() < 2)
    refuse(shares, "table.cortex_share needs at least two shares, such as [0, 0.5, 1].");
  if (const auto* tension = last_of(keys, tension_key))
    refuse(*tension,
           fmt::format("{} does not go with table.cortex_share; give {} instead.", stated(*tension), ratio_key));
  const auto* ratio = last_of(keys, ratio_key);
  if (ratio && given.contains("table.tension_ratio"))
    refuse(*ratio, fmt::format("{} and table.tension_ratio exclude each other; give one of them.", stated(*ratio)));
  if (spec.bending_beyond_kBT > 0)
    refuse(given.at("table.bending_beyond_kBT"),
           "table.bending_beyond_kBT has no effect on combined cells; give table.bending_ratio or "
           "cell.cortex.bending_kBT, which all have.");
  const auto* bending = last_of(keys, bending_key);
  if (bending && spec.bending_ratio > 0)
    refuse(*bending, fmt::format("{} and table.bending_ratio exclude each other; give one of them.", stated(*bending)));
  if (spec.tension_ratios.empty())
    spec.tension_ratios = {ratio && std::holds_alternative<double>(ratio->value) ? std::get<double>(ratio->value) : 0};
}

void choose_stiffness(TableSpec& spec, const std::vector<GivenKey>& keys, const TableKeys& given) {
  const bool bulk = has_bulk(keys), cortex = has_cortex(keys);
  if (given.contains("table.cortex_share")) return check_combined(spec, keys, given);
  for (const auto key : keys_of_combined)
    if (given.contains(key))
      refuse(given.at(key), fmt::format("{} needs table.cortex_share, such as [0, 0.5, 1].", key));
  const auto stated_key = given.find("table.stiffness");
  if (stated_key == given.end()) {
    spec.stiffness_key = stiffness_keys[bulk ? 0 : 1];
    return;
  }
  const auto found = std::ranges::find(stiffness_keys, spec.stiffness_key);
  if (found == stiffness_keys.end())
    refuse(stated_key->second, fmt::format("{} cannot be swept; it can be {}{}", stated(stated_key->second),
                                           quoted_list(stiffness_keys), [&] {
                                             const auto hint = did_you_mean(spec.stiffness_key, stiffness_keys);
                                             return hint.empty() ? std::string(".") : hint;
                                           }()));
  if (spec.is_combined())
    refuse(stated_key->second, "table.stiffness = \"combined\" needs table.cortex_share, such as [0, 0.5, 1].");
  if (found == stiffness_keys.begin() ? !bulk : !cortex)
    refuse(stated_key->second,
           fmt::format("{} cannot be swept, because {} is \"none\"; choose a law, or sweep the other modulus.",
                       stated(stated_key->second), found == stiffness_keys.begin() ? bulk_law_key : cortex_law_key));
}

// Keys of a case that the sweep gives.
std::vector<std::string_view> swept_keys(const TableSpec& spec) {
  std::vector<std::string_view> keys{radius_key, accuracy_key};
  if (!spec.is_combined()) keys.push_back(spec.stiffness_key);
  if (spec.is_combined()) keys.insert(keys.end(), {bulk_modulus_key, cortex_modulus_key});
  return keys;
}

// What the sweep itself gives must not be given as well.
void refuse_swept_keys(const TableSpec& spec, const std::vector<GivenKey>& keys) {
  if (const auto* radius = last_of(keys, radius_key))
    refuse(*radius, fmt::format("{} must not be given, because a table sweeps it; choose table.least_area_um2 and "
                                "table.greatest_area_um2.",
                                stated(*radius)));
  for (const auto key : swept_keys(spec))
    if (const auto* stiffness = last_of(keys, key); stiffness && key != radius_key && key != accuracy_key)
      refuse(*stiffness, fmt::format("{} must not be given, because a table sweeps it; choose table.least_deformation "
                                     "and table.greatest_deformation.",
                                     stated(*stiffness)));
  for (const auto key : {drive_key, std::string_view("flow.pressure_drop_Pa")})
    if (const auto* drive = last_of(keys, key))
      refuse(*drive, fmt::format("{} must not be given, because a table is that of one flow rate; choose "
                                 "flow.rate_ul_per_s.",
                                 stated(*drive)));
  if (const auto* accuracy = last_of(keys, accuracy_key))
    refuse(*accuracy, fmt::format("{} has no effect on a table; choose table.accuracy.", stated(*accuracy)));
}

std::string place_of(const TableKeys& given, std::string_view key, const std::string& name) {
  const auto found = given.find(key);
  return found == given.end() ? name : found->second.where;
}

void check_identifier(const TableSpec& spec, const TableKeys& given, const std::string& name) {
  const auto place = place_of(given, "table.identifier", name);
  const std::string& identifier = spec.identifier;
  const auto shown = one_line(identifier, longest_identifier);
  if (!given.contains("table.identifier"))
    throw UserError(
        fmt::format("{}: the key table.identifier is missing; name the table, for example \"LE-2D-26\".", place));
  const auto is_plain = [](unsigned char c) { return std::isalnum(c) || c == '-'; };
  if (identifier.empty() || identifier.size() > longest_identifier || !std::ranges::all_of(identifier, is_plain))
    throw UserError(
        fmt::format("{}: table.identifier = \"{}\" is no name of a table; take 1 to {} letters, digits and "
                    "hyphens.",
                    place, shown, longest_identifier));
  for (const auto foreign : foreign_identifiers)
    if (edit_distance(identifier, foreign) == 0)
      throw UserError(
          fmt::format("{}: table.identifier = \"{}\" is the name of a published table of others; choose "
                      "another one.",
                      place, shown));
}

void check_order(const TableSpec& spec, const TableKeys& given, const std::string& name) {
  const auto check = [&](double least, double greatest, std::string_view what) {
    if (least < greatest) return;
    const auto place = place_of(given, fmt::format("table.greatest_{}", what), name);
    throw UserError(
        fmt::format("{}: table.least_{} = {:g} is not below table.greatest_{} = {:g}; the table would be "
                    "empty.",
                    place_of(given, fmt::format("table.least_{}", what), place), what, least, what, greatest));
  };
  check(spec.least_area_um2, spec.greatest_area_um2, "area_um2");
  check(spec.least_deformation, spec.greatest_deformation, "deformation");
}

double sphere_area(double radius) { return std::numbers::pi * radius * radius; }

void check_areas(const TableSpec& spec, const TableKeys& given, const std::string& name) {
  const double R = tube_radius_um(spec.base);
  const Range possible{sphere_area(least_radius_ratio * R), sphere_area(greatest_radius_ratio * R)};
  for (const auto& [key, area] : {std::pair("table.least_area_um2", spec.least_area_um2),
                                  std::pair("table.greatest_area_um2", spec.greatest_area_um2)})
    if (!possible.contains(area))
      throw UserError(
          fmt::format("{}: {} = {:g} um2 is an area that no cell of this channel can have; cells of {} .. "
                      "{} of the tube radius {:.6g} um have {:.3g} .. {:.4g} um2.",
                      place_of(given, key, name), key, area, least_radius_ratio, greatest_radius_ratio, R,
                      possible.least, possible.greatest));
}

void check_bending(const TableSpec& spec, const TableKeys& given) {
  const double own = spec.base.cell.cortex.bending_kBT;
  if (spec.bending_beyond_kBT > 0 && spec.bending_beyond_kBT <= own)
    refuse(
        given.at("table.bending_beyond_kBT"),
        fmt::format("table.bending_beyond_kBT = {:g} does not exceed cell.cortex.bending_kBT = {:g}, which all states "
                    "have; raise it or leave it out.",
                    spec.bending_beyond_kBT, own));
}

// Any cell of the sweep, so that the base is a complete case.
BranchPlace middle_of(const TableSpec& spec) {
  BranchPlace place{tube_radius_um(spec.base) / 2};
  if (spec.is_combined()) place = {place.radius_um, 0.5, spec.tension_ratios.front()};
  return place;
}

// What only combined cells have stands in a spec where it is given.
bool is_absent(const TableSpec& spec, const TableKey& key) {
  const auto* number = std::get_if<TableNumber>(&key.value);
  return number && std::ranges::find(keys_of_combined, key.key) != keys_of_combined.end() &&
         number->get(spec) == number->get(TableSpec{});
}

}  // namespace

TableSpec parse_table_spec(std::string_view text, const std::string& name, std::span<const std::string> settings) {
  auto keys = given_keys(text, name, settings);
  const TableKeys given = take_table_keys(keys);
  TableSpec spec;
  for (const auto& [key, value] : given) set_value(spec, *find_table_key(key), value);
  check_identifier(spec, given, name);
  check_order(spec, given, name);
  choose_stiffness(spec, keys, given);
  refuse_swept_keys(spec, keys);
  const Case open_case = case_of_keys(std::move(keys), name, swept_keys(spec));
  spec.base = open_case;
  spec.base = case_at(spec, middle_of(spec), 1);
  check_areas(spec, given, name);
  check_bending(spec, given);
  return spec;
}

TableSpec read_table_spec(const std::filesystem::path& file, std::span<const std::string> settings) {
  return parse_table_spec(read_case_text(file), file.string(), settings);
}

std::string to_toml(const TableSpec& spec) {
  auto left_out = swept_keys(spec);
  left_out.push_back(drive_key);
  if (spec.is_combined()) left_out.push_back(ratio_key);
  if (spec.bending_ratio > 0) left_out.push_back(bending_key);
  std::string text = to_toml(spec.base, left_out) + "\n[table]\n";
  for (const auto& key : table_keys()) {
    const auto* list = std::get_if<TableList>(&key.value);
    if (list && (spec.*(list->field)).empty()) continue;
    if (is_absent(spec, key)) continue;
    text += fmt::format("{} = ", key.key.substr(key.key.find('.') + 1));
    if (list)
      text += fmt::format("[{}]\n", fmt::join(spec.*(list->field), ", "));
    else if (const auto* word = std::get_if<TableWord>(&key.value))
      text += fmt::format("\"{}\"\n", spec.*(word->field));
    else
      text += fmt::format("{}\n", std::get<TableNumber>(key.value).get(spec));
  }
  return text;
}

std::string spec_hash(const TableSpec& spec) { return fingerprint(to_toml(spec)); }

}  // namespace rheocyte

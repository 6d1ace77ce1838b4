#include "synth/synth_spec.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "analytic/small_deformation.h"
#include "case/case_text.h"
#include "case/given_keys.h"
#include "case/nearest_name.h"
#include "case/user_error.h"
#include "measurement/viscosity.h"
#include "synth/synth_keys.h"

namespace rheocyte {

namespace {

using GivenByKey = std::map<std::string, GivenKey>;

constexpr std::array spread_parts{".mean", ".sd", ".distribution"};

[[noreturn]] void refuse(const GivenKey& given, const std::string& reason) {
  throw UserError(fmt::format("{}: {}", given.where, reason));
}

std::string stated(const GivenKey& given) { return fmt::format("{} = {}", one_line(given.key, 80), value_text(given)); }

std::vector<std::string> known_names() {
  std::vector<std::string> names;
  for (const auto& key : synth_keys()) {
    names.emplace_back(key.key);
    if (std::holds_alternative<SynthSpread>(key.value))
      for (const char* const part : spread_parts) names.push_back(std::string(key.key) + part);
  }
  return names;
}

GivenByKey known_keys(std::vector<GivenKey> keys) {
  const auto names = known_names();
  const std::vector<std::string_view> views(names.begin(), names.end());
  GivenByKey known;
  for (auto& given : keys) {
    const bool is_section =
        std::ranges::any_of(names, [&](const auto& name) { return name.starts_with(given.key + "."); });
    const auto* unusable = std::get_if<Unusable>(&given.value);
    if (is_section && unusable && unusable->what == "a section") continue;  // an empty one is no mistake
    if (std::ranges::find(names, given.key) == names.end()) {
      const auto hint = did_you_mean(given.key, views);
      refuse(given, fmt::format("unknown key {}{}", stated(given),
                                hint.empty() ? "; docs/plot-and-synth.md lists all keys." : hint));
    }
    known.insert_or_assign(given.key, std::move(given));
  }
  return known;
}

double number_of(const GivenKey& given, const Range& range, const SynthKey& key) {
  const auto* value = std::get_if<double>(&given.value);
  const auto allowed = fmt::format("{} ({})", allowed_values(key), key.sentence);
  if (!value) refuse(given, fmt::format("{} is not a number; it can be {}.", stated(given), allowed));
  if (!range.contains(*value))
    refuse(given, fmt::format("{} is outside its range; it can be {}.", stated(given), allowed));
  return *value;
}

void set_number(SynthSpec& spec, const SynthKey& key, const SynthNumber& number, const GivenByKey& keys,
                const std::string& name) {
  const auto given = keys.find(std::string(key.key));
  if (given == keys.end()) {
    if (number.fallback) return number.set(spec, *number.fallback);
    if (!number.is_required) return;
    throw UserError(
        fmt::format("{}: the key {} is missing; it can be {} ({}).", name, key.key, allowed_values(key), key.sentence));
  }
  const double value = number_of(given->second, number.range, key);
  if (number.is_whole && value != std::floor(value))
    refuse(given->second, fmt::format("{} must be a whole number.", stated(given->second)));
  number.set(spec, value);
}

void set_word(SynthSpec& spec, const SynthKey& key, const SynthWord& word, const GivenByKey& keys) {
  const auto given = keys.find(std::string(key.key));
  if (given == keys.end()) return word.set(spec, std::string(word.fallback));
  const auto* text = std::get_if<std::string>(&given->second.value);
  constexpr std::size_t longest = 100;
  if (!text || text->size() > longest)
    refuse(given->second, fmt::format("{} must be {}.", stated(given->second), allowed_values(key)));
  if (!word.options.empty() && std::ranges::find(word.options, *text) == word.options.end()) {
    const auto hint = did_you_mean(*text, word.options);
    refuse(given->second, fmt::format("{} is not known; it can be {}{}", stated(given->second), allowed_values(key),
                                      hint.empty() ? "." : hint));
  }
  word.set(spec, *text);
}

Spread::Law law_of(const GivenKey& given) {
  constexpr std::array<std::string_view, 2> laws{"normal", "lognormal"};
  const auto* text = std::get_if<std::string>(&given.value);
  if (text && *text == laws[0]) return Spread::Law::normal;
  if (text && *text == laws[1]) return Spread::Law::lognormal;
  const auto hint = text ? did_you_mean(*text, laws) : "";
  refuse(given, fmt::format("{} is not known; it can be \"normal\" or \"lognormal\"{}", stated(given),
                            hint.empty() ? "." : hint));
}

// False if nothing is given and there is no default.
bool set_spread(SynthSpec& spec, const SynthKey& key, const SynthSpread& wanted, const GivenByKey& keys) {
  const std::string name(key.key);
  const auto part = [&](const char* suffix) {
    const auto found = keys.find(name + suffix);
    return found == keys.end() ? nullptr : &found->second;
  };
  const auto *plain = part(""), *mean = part(".mean"), *deviation = part(".sd"), *law = part(".distribution");
  if (!plain && !mean && !wanted.fallback) {
    if (deviation || law)
      refuse(deviation ? *deviation : *law,
             fmt::format("{} needs {}.mean, too.", (deviation ? *deviation : *law).key, name));
    return false;
  }
  Spread spread{Spread::Law::normal, wanted.fallback.value_or(0), 0};
  if (plain || mean) spread.mean = number_of(plain ? *plain : *mean, wanted.range, key);
  if (deviation) spread.deviation = number_of(*deviation, {0, wanted.range.greatest}, key);
  if (law) spread.law = law_of(*law);
  wanted.set(spec, spread);
  return true;
}

/// What can be given of a cell, and for which kinds.
struct CellKey {
  std::string_view key;
  std::vector<CellKind> kinds;
  bool is_required = true;
};

std::string_view name_of(CellKind kind) {
  return kind == CellKind::solid ? "solid" : kind == CellKind::shell ? "shell" : "combined";
}

void read_moduli(SynthSpec& spec, const GivenByKey& keys, const std::string& name) {
  using enum CellKind;
  const std::array<CellKey, 4> table{{{"cell.young_modulus_kPa", {solid, combined}},
                                      {"cell.cortex_modulus_mN_per_m", {shell, combined}},
                                      {"cell.tension_ratio", {shell, combined}, false},
                                      {"cell.tension_mN_per_m", {combined}, false}}};
  for (const auto& [wanted, kinds, is_required] : table) {
    const auto key = std::ranges::find(synth_keys(), wanted, &SynthKey::key);
    if (std::ranges::find(kinds, spec.kind) != kinds.end()) {
      if (!set_spread(spec, *key, std::get<SynthSpread>(key->value), keys) && is_required)
        throw UserError(fmt::format("{}: the key {} is missing; it can be {} ({}).", name, wanted, allowed_values(*key),
                                    key->sentence));
      continue;
    }
    std::string others;
    for (const CellKind kind : kinds) others += fmt::format("{}\"{}\"", others.empty() ? "" : " or ", name_of(kind));
    for (const auto& [given_key, given] : keys)
      if (given_key == wanted || given_key.starts_with(std::string(wanted) + "."))
        refuse(given, fmt::format("{} has no effect, because cell.kind is \"{}\"; remove it or choose {}.",
                                  stated(given), name_of(spec.kind), others));
  }
}

// The first one that is given of a key and its parts.
const GivenKey* any_part(const GivenByKey& keys, const std::string& key) {
  const auto found = std::ranges::find_if(
      keys, [&](const auto& entry) { return entry.first == key || entry.first.starts_with(key + "."); });
  return found == keys.end() ? nullptr : &found->second;
}

void check_tension(const SynthSpec& spec, const GivenByKey& keys) {
  if (spec.tension_ratio && spec.tension_mN_per_m)
    refuse(*any_part(keys, "cell.tension_mN_per_m"),
           "cell.tension_ratio and cell.tension_mN_per_m exclude each other; give one of them.");
  if (spec.kind == CellKind::shell && spec.tension_ratio && spec.tension_ratio->deviation > 0)
    refuse(keys.at("cell.tension_ratio.sd"),
           "cell.tension_ratio is one number for all shells; only combined cells have a spread of it.");
}

void check_liquid(const SynthSpec& spec, const GivenByKey& keys, const std::string& name) {
  if (spec.viscosity_mPas) {
    for (const auto& [key, given] : keys)
      if (key == "flow.medium" || key == "flow.viscosity_model" || key.starts_with("flow.temperature_C"))
        refuse(given, fmt::format("{} has no effect, because flow.viscosity_mPas is given; remove one of them.",
                                  stated(given)));
    return;
  }
  if (spec.medium.empty())
    throw UserError(
        fmt::format("{}: the liquid is missing; give flow.viscosity_mPas, or flow.medium, e.g. "
                    "\"CellCarrier\".",
                    name));
  const auto medium = medium_of_name(spec.medium);
  if (!medium)
    refuse(keys.at("flow.medium"), fmt::format("{} has no known viscosity; it can be CellCarrier, CellCarrierB, 0.83% "
                                               "MC-PBS or water, or give flow.viscosity_mPas.",
                                               stated(keys.at("flow.medium"))));
  try {
    const Buffer check(*medium, *viscosity_model_of_name(spec.viscosity_model));
  } catch (const UserError& error) {
    refuse(keys.at("flow.medium"), error.what());
  }
}

// Digits where `pattern` has a 0, its own characters elsewhere.
void check_pattern(const GivenByKey& keys, const std::string& key, std::string_view pattern, const char* shown) {
  const auto given = keys.find(key);
  if (given == keys.end()) return;
  const auto& text = std::get<std::string>(given->second.value);
  const auto fits = [](char wanted, char is) { return wanted == '0' ? is >= '0' && is <= '9' : is == wanted; };
  if (text.size() != pattern.size() || !std::ranges::equal(pattern, text, fits))
    refuse(given->second, fmt::format("{} must have the form {}.", stated(given->second), shown));
}

void check_shapes(SynthSpec& spec, const GivenByKey& keys, const std::string& name) {
  if (!spec.table.empty()) {
    std::vector<std::string> without_effect{"shapes.greatest_deformation", "shapes.duct"};
    if (spec.kind != CellKind::combined) without_effect.emplace_back("cell.tension_ratio");
    for (const auto& key : without_effect)
      if (const auto* given = any_part(keys, key))
        refuse(*given,
               fmt::format("{} has no effect, because shapes.table is given; remove one of them.", stated(*given)));
    return;
  }
  if (spec.kind == CellKind::combined)
    throw UserError(
        fmt::format("{}: cell.kind = \"combined\" needs shapes.table, the folder of a table with table.cortex_share; "
                    "the closed model has no such cells.",
                    name));
  if (spec.greatest_deformation == 0)
    spec.greatest_deformation = spec.kind == CellKind::solid ? greatest_solid_deformation : greatest_shell_deformation;
}

}  // namespace

double Spread::at(double normal) const {
  if (law == Law::normal) return mean + deviation * normal;
  const double variance = std::log1p(deviation * deviation / (mean * mean));
  return mean * std::exp(std::sqrt(variance) * normal - 0.5 * variance);
}

ImageSize SynthSpec::image_size() const {
  constexpr double beyond_the_walls_um = 3;
  const double needed = (channel_width_um + 2 * beyond_the_walls_um) / pixel_size_um;
  const double height = height_px > 0 ? height_px : 2 * std::ceil(0.5 * needed);
  return {static_cast<std::size_t>(width_px), static_cast<std::size_t>(height)};
}

SynthSpec parse_synth_spec(std::string_view text, const std::string& name) {
  check_case_text(text, name);
  const GivenByKey keys = known_keys(keys_in_toml(text, name));
  SynthSpec spec;
  for (const auto& key : synth_keys()) {
    if (const auto* number = std::get_if<SynthNumber>(&key.value)) set_number(spec, key, *number, keys, name);
    if (const auto* word = std::get_if<SynthWord>(&key.value)) set_word(spec, key, *word, keys);
  }
  read_moduli(spec, keys, name);
  check_tension(spec, keys);
  for (const char* const wanted : {"cell.radius_um", "flow.temperature_C"}) {
    const auto key = std::ranges::find(synth_keys(), wanted, &SynthKey::key);
    if (!set_spread(spec, *key, std::get<SynthSpread>(key->value), keys))
      throw UserError(fmt::format("{}: the key {} is missing; it can be {} ({}).", name, wanted, allowed_values(*key),
                                  key->sentence));
  }
  check_liquid(spec, keys, name);
  check_pattern(keys, "recording.date", "0000-00-00", "YYYY-MM-DD");
  check_pattern(keys, "recording.time", "00:00:00", "HH:MM:SS");
  if (spec.image_size().height > 4000)
    throw UserError(fmt::format("{}: the channel is {} pixels wide; give a larger recording.pixel_size_um.", name,
                                std::floor(spec.channel_width_um / spec.pixel_size_um)));
  check_shapes(spec, keys, name);
  return spec;
}

}  // namespace rheocyte

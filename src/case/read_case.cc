#include "case/read_case.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <vector>

#include "case/case_text.h"
#include "case/given_keys.h"
#include "case/nearest_name.h"
#include "case/parameters.h"
#include "case/scales.h"
#include "case/user_error.h"

namespace rheocyte {

namespace {

using GivenByKey = std::map<std::string_view, GivenKey>;

[[noreturn]] void refuse(const GivenKey& given, const std::string& reason) {
  throw UserError(fmt::format("{}: {}", given.where, reason));
}

std::string stated(const GivenKey& given) { return fmt::format("{} = {}", one_line(given.key, 80), value_text(given)); }

bool is_section(std::string_view name) {
  const std::string prefix = std::string(name) + ".";
  return std::ranges::any_of(parameters(), [&](const Parameter& p) { return p.key.starts_with(prefix); });
}

bool is_given_as_section(const GivenKey& given) {
  const auto* unusable = std::get_if<Unusable>(&given.value);
  return unusable && unusable->what == "a section";
}

[[noreturn]] void refuse_unknown(const GivenKey& given) {
  if (is_section(given.key))
    refuse(given, fmt::format("{} is a section, not a value; write [{}] and its keys below.", given.key, given.key));
  if (const auto* parent = find_parameter(given.key.substr(0, given.key.rfind('.'))))
    refuse(given, fmt::format("{} stands below {}, which takes a value: {}.", stated(given), parent->key,
                              allowed_values(*parent)));
  std::vector<std::string_view> known;
  for (const auto& parameter : parameters()) known.push_back(parameter.key);
  const auto hint = did_you_mean(given.key, known);
  const auto what = is_given_as_section(given) ? fmt::format("section [{}]", one_line(given.key, 80))
                                               : fmt::format("key {}", stated(given));
  refuse(given, fmt::format("unknown {}{}", what, hint.empty() ? "; `rheocyte help case` lists all keys." : hint));
}

// Later keys, those of --set, replace earlier ones.
GivenByKey known_keys(std::vector<GivenKey> keys) {
  GivenByKey known;
  for (auto& given : keys) {
    if (is_given_as_section(given) && is_section(given.key)) continue;  // an empty section is no mistake
    const Parameter* parameter = find_parameter(given.key);
    if (!parameter) refuse_unknown(given);
    const auto earlier = known.find(parameter->key);
    if (earlier != known.end() && !given.from_set)
      refuse(given, fmt::format("{} is given for the second time.", stated(given)));
    known.insert_or_assign(parameter->key, std::move(given));
  }
  return known;
}

void set_number(Case& c, const Parameter& parameter, const GivenKey& given) {
  const auto& number = std::get<Number>(parameter.value);
  const auto* value = std::get_if<double>(&given.value);
  const auto allowed = fmt::format("{} ({})", allowed_values(parameter), parameter.sentence);
  if (!value) refuse(given, fmt::format("{} is not a number; it can be {}.", stated(given), allowed));
  if (!std::isfinite(*value)) refuse(given, fmt::format("{} is not finite; it can be {}.", stated(given), allowed));
  if (!number.range.contains(*value)) refuse(given, fmt::format("{} is outside its range {}.", stated(given), allowed));
  number.set(c, *value);
}

void set_choice(Case& c, const Parameter& parameter, const GivenKey& given) {
  const auto& choice = std::get<Choice>(parameter.value);
  const auto* word = std::get_if<std::string>(&given.value);
  if (!word) refuse(given, fmt::format("{} must be a word: {}.", stated(given), allowed_values(parameter)));
  const auto found = std::ranges::find(choice.options, *word);
  if (found == choice.options.end()) {
    const auto hint = did_you_mean(*word, choice.options);
    refuse(given, fmt::format("{} is not known; it can be {}{}", stated(given), allowed_values(parameter),
                              hint.empty() ? "." : hint));
  }
  choice.set(c, static_cast<int>(found - choice.options.begin()));
}

void set_list(Case& c, const Parameter& parameter, const GivenKey& given) {
  const auto& list = std::get<List>(parameter.value);
  const auto* values = std::get_if<std::vector<double>>(&given.value);
  const auto what = fmt::format("{} ({})", allowed_values(parameter), parameter.sentence);
  if (!values)
    refuse(given, fmt::format("{} is no list of numbers, for example [0, 60]; it can be {}.", stated(given), what));
  for (const double value : *values)
    if (!list.range.contains(value))
      refuse(given, fmt::format("{} contains {}, which is outside its range; it can be {}.", given.key, value, what));
  list.at(c) = *values;
}

void set_value(Case& c, const Parameter& parameter, const GivenKey& given) {
  if (std::holds_alternative<Number>(parameter.value)) return set_number(c, parameter, given);
  if (std::holds_alternative<List>(parameter.value)) return set_list(c, parameter, given);
  set_choice(c, parameter, given);
}

// Choices come first: they decide which of the other keys have an effect.
void read_choices(Case& c, const GivenByKey& keys) {
  for (const auto& parameter : parameters()) {
    const auto* choice = std::get_if<Choice>(&parameter.value);
    if (!choice) continue;
    if (choice->fallback) choice->set(c, *choice->fallback);
    if (const auto given = keys.find(parameter.key); given != keys.end()) set_choice(c, parameter, given->second);
  }
  // Who gives a time wants to follow it.
  const auto first_of_time = keys.lower_bound("time.");
  const bool has_time = first_of_time != keys.end() && first_of_time->first.starts_with("time.");
  if (has_time && !keys.contains("time.scheme")) c.time.scheme = TimeScheme::monolithic;
  const bool has_drop = keys.contains("flow.pressure_drop_Pa") && !keys.contains("flow.rate_ul_per_s");
  if (has_drop && !keys.contains("flow.drive")) c.flow.drive = Drive::pressure_drop;
}

bool was_set(const GivenByKey& keys, std::string_view key) {
  const auto given = keys.find(key);
  return given != keys.end() && given->second.from_set;
}

// Refuses a key that has no effect, unless a setting has taken its effect from it.
void check_effect(const Case& c, const Parameter& parameter, GivenByKey& keys) {
  const auto given = keys.find(parameter.key);
  if (given == keys.end() || applies(parameter, c)) return;
  const auto& condition = *parameter.only_for;
  if (!given->second.from_set && was_set(keys, condition.key)) {
    keys.erase(given);
    return;
  }
  const auto kind = condition.key.substr(condition.key.rfind('.') + 1);
  const auto choice = condition.negated ? fmt::format("another {}", kind) : fmt::format("\"{}\"", condition.option);
  refuse(given->second, fmt::format("{} has no effect, because {} is \"{}\"; remove it or choose {}.",
                                    stated(given->second), condition.key, chosen_option(c, condition.key), choice));
}

// Of two alternatives exactly one stays; a setting wins over the file.
void check_alternative(const Parameter& parameter, GivenByKey& keys) {
  if (parameter.alternative.empty()) return;
  const auto given = keys.find(parameter.key), other = keys.find(parameter.alternative);
  if (given == keys.end() || other == keys.end()) return;
  if (given->second.from_set != other->second.from_set) {
    keys.erase(given->second.from_set ? other : given);
    return;
  }
  refuse(other->second, fmt::format("{} and {} exclude each other; give exactly one of them.", stated(given->second),
                                    stated(other->second)));
}

void read_number(Case& c, const Parameter& parameter, const GivenByKey& keys, const std::string& name) {
  const auto& number = std::get<Number>(parameter.value);
  if (const auto given = keys.find(parameter.key); given != keys.end()) return set_number(c, parameter, given->second);
  if (!applies(parameter, c) || keys.contains(parameter.alternative)) return;
  if (number.fallback) return number.set(c, *number.fallback);
  if (!is_required(parameter)) return;
  const auto instead = parameter.alternative.empty() ? "" : fmt::format(" (or {})", parameter.alternative);
  const auto reason = parameter.only_for ? fmt::format(" for {}", condition_text(*parameter.only_for)) : "";
  throw UserError(fmt::format("{}: the key {}{} is missing{}; it can be {} ({}).", name, parameter.key, instead, reason,
                              allowed_values(parameter), parameter.sentence));
}

constexpr std::string_view profile_x = "channel.profile.x_um", profile_R = "channel.profile.R_um";

bool has_profile(const GivenByKey& keys) { return keys.contains(profile_x) || keys.contains(profile_R); }

// The mesh follows the wall along straight spokes and has elements as wide as the tube.
constexpr double steepest_wall = 0.5, greatest_widening = 5;
constexpr std::size_t most_places = 1000;

void check_wall(const ChannelProfile& wall, const GivenKey& x, const GivenKey& R) {
  const std::size_t n = wall.x_um.size();
  if (wall.R_um.size() != n)
    refuse(R, fmt::format("{} has {} numbers and {} has {}; give one radius for each place.", profile_R,
                          wall.R_um.size(), profile_x, n));
  if (n < 2 || n > most_places)
    refuse(x, fmt::format("{} has {} places; a profile needs 2 .. {}, before and behind the contraction.", profile_x, n,
                          most_places));
  for (std::size_t i = 1; i < n; ++i) {
    const double length = wall.x_um[i] - wall.x_um[i - 1], change = std::abs(wall.R_um[i] - wall.R_um[i - 1]);
    if (!(length > 0))
      refuse(x, fmt::format("{} does not increase from {} to {}; give the places in the order of the flow.", profile_x,
                            wall.x_um[i - 1], wall.x_um[i]));
    if (change > steepest_wall * length)
      refuse(R,
             fmt::format("{} changes by {:.4g} um between x = {} and {} um, which is too short and too steep for the "
                         "mesh; give this change a length of {:.4g} um.",
                         profile_R, change, wall.x_um[i - 1], wall.x_um[i], change / steepest_wall));
  }
}

void check_profile(const Case& c, const GivenByKey& keys) {
  if (!has_profile(keys)) return;
  for (const auto& [one, other] : {std::pair{profile_x, profile_R}, std::pair{profile_R, profile_x}})
    if (!keys.contains(one))
      refuse(keys.at(other), fmt::format("{} is given without {}; give both, or channel.radius_um for a straight "
                                         "channel.",
                                         other, one));
  const auto &x = keys.at(profile_x), &R = keys.at(profile_R);
  for (const auto* straight : {"channel.width_um", "channel.radius_um"})
    if (const auto given = keys.find(straight); given != keys.end())
      refuse(given->second, fmt::format("{} and the section [channel.profile] exclude each other; give exactly one of "
                                        "them.",
                                        stated(given->second)));
  check_wall(c.channel.profile, x, R);
  const double least = tube_radius_um(c), widest = *std::ranges::max_element(c.channel.profile.R_um);
  if (widest > greatest_widening * least)
    refuse(R,
           fmt::format("{} goes from {:g} to {:g} um; the widest part may be {:g} times as wide as the narrowest one.",
                       profile_R, least, widest, greatest_widening));
  if (c.flow.drive == Drive::rate) return;
  const auto& drive = keys.at(keys.contains("flow.drive") ? "flow.drive" : "flow.pressure_drop_Pa");
  refuse(drive,
         fmt::format("{} is for straight channels; give flow.rate_ul_per_s with [channel.profile].", stated(drive)));
}

void check_cell_in_tube(const Case& c, const GivenByKey& keys) {
  const double R = tube_radius_um(c), r0 = c.cell.radius_um;
  if (has_profile(keys) && r0 > greatest_radius_ratio * R)
    refuse(
        keys.at(profile_R),
        fmt::format("{} falls to {:g} um, which is narrower than the cell of cell.radius_um = {:g} can pass; at least "
                    "{:.4g} um are needed.",
                    profile_R, R, r0, r0 / greatest_radius_ratio));
  if (r0 >= least_radius_ratio * R && r0 <= greatest_radius_ratio * R) return;
  const auto& given = keys.at("cell.radius_um");
  refuse(given, fmt::format("{} is outside its range {:.4g} .. {:.4g} um, {} .. {} of the tube radius {:.6g} um.",
                            stated(given), least_radius_ratio * R, greatest_radius_ratio * R, least_radius_ratio,
                            greatest_radius_ratio, R));
}

// The ends of the channel must not see the cell.
void check_length(const Case& c, const GivenByKey& keys) {
  if (!c.channel.length_um) return;
  const double R = tube_radius_um(c), least = 2 * R * least_half_length(c.cell.radius_um / R);
  if (*c.channel.length_um >= least) return;
  const auto& given = keys.at("channel.length_um");
  refuse(given, fmt::format("{} is too short for the flow round the cell; it must be at least {:.4g} um, give the "
                            "pressure drop over such a length.",
                            stated(given), std::ceil(least)));
}

// A liquid interior at rest holds no shear stress: the surface must, or the liquid drags it round without end.
void check_cell_is_elastic(const Case& c, const GivenByKey& keys) {
  if (c.cell.bulk.law != BulkLaw::none || c.cell.cortex.law != CortexLaw::none) return;
  const auto& given = keys.at("cell.bulk.law");
  const bool drop = c.cell.cortex.tension_mN_per_m.value_or(0) > 0 || c.cell.cortex.bending_kBT > 0;
  refuse(given, fmt::format("{} and cell.cortex.law = \"none\" leave {}; choose a law for the bulk or the cortex.",
                            stated(given),
                            drop ? "a drop, which circulates inside and has no stationary shape of this kind"
                                 : "a cell without any elasticity or tension"));
}

// Frames are kept in memory and drawn one by one.
constexpr double greatest_outputs = 10000;

// Such grids are for the low degrees of the paper; the cell has about a tenth of the square of these elements.
constexpr int most_surface_elements = 400;
constexpr double greatest_grid_degree = 3;

void check_grid(const Case& c, const GivenByKey& keys) {
  if (c.time.grid_um.value_or(0) == 0) return;
  const auto& given = keys.at("time.grid_um");
  if (surface_elements(c) > most_surface_elements)
    refuse(given, fmt::format("{} makes {} elements along the surface; at most {} are possible, a size of {:.3g} um.",
                              stated(given), surface_elements(c), most_surface_elements,
                              std::numbers::pi * c.cell.radius_um / most_surface_elements));
  if (*c.time.degree > greatest_grid_degree)
    refuse(given, fmt::format("{} is for low degrees, and time.degree is {:g}; choose time.degree = 2 as in the paper.",
                              stated(given), *c.time.degree));
}

void check_time(const Case& c, const GivenByKey& keys) {
  if (c.flow.drive == Drive::controlled_pressure && c.time.scheme != TimeScheme::partitioned)
    refuse(
        keys.at("flow.drive"),
        fmt::format("{} adapts the pressure step by step, which is for time.scheme = \"partitioned\" only; remove it, "
                    "a given flow rate is met exactly.",
                    stated(keys.at("flow.drive"))));
  if (c.time.scheme == TimeScheme::stationary) return;
  if (const double degree = *c.time.degree; degree != std::round(degree))
    refuse(keys.at("time.degree"), fmt::format("{} is not a whole number.", stated(keys.at("time.degree"))));
  check_grid(c, keys);
  const double end = *c.time.end_us, outputs = end / *c.time.output_every_us;
  if (outputs > greatest_outputs)
    refuse(keys.at("time.end_us"),
           fmt::format("{} and time.output_every_us = {:g} ask for {:.3g} outputs; at most {:g} are possible.",
                       stated(keys.at("time.end_us")), *c.time.output_every_us, outputs, greatest_outputs));
}

}  // namespace

Case case_of_keys(std::vector<GivenKey> keys_in_order, const std::string& name,
                  std::span<const std::string_view> left_open) {
  const auto is_open = [&](std::string_view key) { return std::ranges::find(left_open, key) != left_open.end(); };
  GivenByKey keys = known_keys(std::move(keys_in_order));

  Case c;
  Case probe;  // every given value must be right by itself, even where it has no effect
  for (const auto& [key, given] : keys) set_value(probe, *find_parameter(key), given);
  read_choices(c, keys);
  for (const auto& parameter : parameters()) {
    check_effect(c, parameter, keys);
    check_alternative(parameter, keys);
  }
  for (const auto& parameter : parameters()) {
    const bool is_number = std::holds_alternative<Number>(parameter.value);
    const bool replaced =
        has_profile(keys) && (parameter.key == "channel.width_um" || parameter.key == "channel.radius_um");
    if (is_number && !replaced && !is_open(parameter.key)) read_number(c, parameter, keys, name);
    if (const auto given = keys.find(parameter.key);
        given != keys.end() && std::holds_alternative<List>(parameter.value))
      set_list(c, parameter, given->second);
  }
  check_profile(c, keys);
  if (!is_open("cell.radius_um")) {
    check_cell_in_tube(c, keys);
    check_length(c, keys);
  }
  check_cell_is_elastic(c, keys);
  check_time(c, keys);
  return c;
}

std::vector<GivenKey> given_keys(std::string_view text, const std::string& name,
                                 std::span<const std::string> settings) {
  check_case_text(text, name);
  auto keys = keys_in_toml(text, name);
  for (const auto& setting : settings) keys.push_back(key_in_setting(setting));
  return keys;
}

Case parse_case(std::string_view text, const std::string& name, std::span<const std::string> settings) {
  return case_of_keys(given_keys(text, name, settings), name, {});
}

Case read_case(const std::filesystem::path& file, std::span<const std::string> settings) {
  return parse_case(read_case_text(file), file.string(), settings);
}

}  // namespace rheocyte

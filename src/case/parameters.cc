#include "case/parameters.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>

namespace rheocyte {

namespace {

// `field` is a function from a Case to one of its members.
template <auto field>
Number number(Range range, std::optional<double> fallback = {}) {
  return {range, fallback, [](const Case& c) -> std::optional<double> { return field(c); },
          [](Case& c, double value) { field(c) = value; }};
}

template <auto field>
Choice choice(std::vector<std::string_view> options, int fallback) {
  return {std::move(options), fallback, [](const Case& c) { return static_cast<int>(field(c)); },
          [](Case& c, int option) {
            auto& member = field(c);
            member = static_cast<std::remove_reference_t<decltype(member)>>(option);
          }};
}

#define FIELD(path) \
  [](auto& c) -> auto& { return c.path; }

constexpr Condition newtonian{"flow.law", "newtonian"}, power_law{"flow.law", "power-law"},
    mooney_rivlin{"cell.bulk.law", "mooney-rivlin"};

// The options of a choice stand in the order of its enumeration (case/problem.h).
// The ranges are wide; they catch wrong units and keep every dimensionless group finite.
const std::array table{
    Parameter{"channel.width_um",
              "um",
              "width of the square channel, mapped to a tube of radius 0.547 x width",
              number<FIELD(channel.width_um)>({1, 10000}),
              {},
              "channel.radius_um"},
    Parameter{"channel.radius_um",
              "um",
              "radius of the tube",
              number<FIELD(channel.radius_um)>({0.5, 5000}),
              {},
              "channel.width_um"},

    Parameter{"flow.rate_ul_per_s", "ul/s", "flow rate through the channel, sheath and sample together",
              number<FIELD(flow.rate_ul_per_s)>({1e-9, 1e3})},
    Parameter{"flow.law", "", "law of the liquid, power-law: viscosity = consistency x shear rate^(exponent - 1)",
              choice<FIELD(flow.law)>({"newtonian", "power-law"}, 0)},
    Parameter{"flow.viscosity_mPas", "mPa s", "viscosity of the liquid",
              number<FIELD(flow.viscosity_mPas)>({1e-3, 1e7}), newtonian},
    Parameter{"flow.consistency_Pa_sn", "Pa s^n", "consistency of the shear-thinning liquid",
              number<FIELD(flow.consistency_Pa_sn)>({1e-6, 1e4}), power_law},
    Parameter{"flow.exponent", "", "exponent n of the shear-thinning liquid, 1 = Newtonian",
              number<FIELD(flow.exponent)>({0.1, 2}), power_law},
    Parameter{"flow.shear_rate_floor", "",
              "shear rate, relative to mean speed / tube radius, below which the viscosity levels off",
              number<FIELD(flow.shear_rate_floor)>({1e-6, 1}, 0.01), power_law},
    Parameter{"flow.density_kg_per_m3", "kg/m3", "density of the liquid, 0 = no inertia (Stokes flow)",
              number<FIELD(flow.density_kg_per_m3)>({0, 1e6}, 1000)},

    Parameter{"cell.radius_um", "um", "radius of the unstressed, spherical cell, 0.05 .. 0.95 of the tube radius",
              number<FIELD(cell.radius_um)>({0.01, 5000})},
    Parameter{"cell.bulk.law", "", "elastic law of the cell's interior",
              choice<FIELD(cell.bulk.law)>({"linear", "neo-hookean", "mooney-rivlin"}, 1)},
    Parameter{"cell.bulk.young_modulus_kPa", "kPa", "Young's modulus of the cell's interior, which is incompressible",
              number<FIELD(cell.bulk.young_modulus_kPa)>({1e-6, 1e9})},
    Parameter{"cell.bulk.mooney_share", "", "share of the neo-hookean law in the mooney-rivlin one, the rest is linear",
              number<FIELD(cell.bulk.mooney_share)>({0, 1}, 0.5), mooney_rivlin},

    Parameter{"numerics.accuracy", "", "wanted relative accuracy of the deformation, mesh and degree are chosen for it",
              number<FIELD(numerics.accuracy)>({1e-7, 1e-1}, 1e-4)},
};

#undef FIELD

// 1e-9 rather than fmt's 1e-09, and 1e7 rather than 1e+07.
std::string short_number(double value) {
  std::string text = fmt::format("{:g}", value);
  const auto exponent = text.find('e');
  if (exponent == std::string::npos) return text;
  const bool negative = text[exponent + 1] == '-';
  return text.substr(0, exponent) + (negative ? "e-" : "e") + text.substr(text.find_first_not_of("0+-", exponent + 1));
}

}  // namespace

std::span<const Parameter> parameters() { return table; }

const Parameter* find_parameter(std::string_view key) {
  const auto found = std::find_if(table.begin(), table.end(), [&](const auto& p) { return p.key == key; });
  return found == table.end() ? nullptr : &*found;
}

std::string_view chosen_option(const Case& c, std::string_view key) {
  const auto& choice = std::get<Choice>(find_parameter(key)->value);
  return choice.options[static_cast<std::size_t>(choice.get(c))];
}

bool applies(const Parameter& parameter, const Case& c) {
  return !parameter.only_for || chosen_option(c, parameter.only_for->key) == parameter.only_for->option;
}

std::string allowed_values(const Parameter& parameter) {
  if (const auto* number = std::get_if<Number>(&parameter.value))
    return fmt::format("{} .. {}{}{}", short_number(number->range.least), short_number(number->range.greatest),
                       parameter.unit.empty() ? "" : " ", parameter.unit);
  std::vector<std::string> quoted;
  for (const auto option : std::get<Choice>(parameter.value).options) quoted.push_back(fmt::format("\"{}\"", option));
  return fmt::format("{}", fmt::join(quoted, " or "));
}

std::string fallback_text(const Parameter& parameter) {
  if (const auto* number = std::get_if<Number>(&parameter.value))
    return number->fallback ? short_number(*number->fallback) : "required";
  const auto& choice = std::get<Choice>(parameter.value);
  return choice.fallback ? fmt::format("\"{}\"", choice.options[static_cast<std::size_t>(*choice.fallback)])
                         : "required";
}

}  // namespace rheocyte

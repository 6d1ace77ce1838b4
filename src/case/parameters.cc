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
List list(Range range) {
  return {range, [](Case& c) -> std::vector<double>& { return field(c); }};
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
    mooney_rivlin{"cell.bulk.law", "mooney-rivlin"}, has_bulk{"cell.bulk.law", "none", true},
    has_shell{"cell.cortex.law", "none", true}, in_time{"time.scheme", "stationary", true},
    monolithic{"time.scheme", "monolithic"}, partitioned{"time.scheme", "partitioned"},
    has_rate{"flow.drive", "pressure-drop", true}, has_pressure_drop{"flow.drive", "pressure-drop"};

// The options of a choice stand in the order of its enumeration (case/problem.h, laws/).
// The ranges are wide; they catch wrong units and keep every dimensionless group finite.
const std::array table = {
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
    Parameter{"channel.length_um", "um", "length of the channel over which the given pressure drops",
              number<FIELD(channel.length_um)>({1, 1e6}), has_pressure_drop},
    Parameter{"channel.profile.x_um", "um",
              "places along a channel that is not straight, in place of its width or radius; the cell starts at 0",
              list<FIELD(channel.profile.x_um)>({-1e6, 1e6}), monolithic},
    Parameter{"channel.profile.R_um", "um",
              "radii of the wall at these places, smooth and monotonic in between, constant beyond the ends",
              list<FIELD(channel.profile.R_um)>({0.5, 5000}), monolithic},

    Parameter{"flow.drive", "",
              "what is given: the flow rate; the pressure drop, with the flow rate as a result; the flow rate, reached "
              "through a pressure drop that is adapted in each step as in Mokbel et al. 2017",
              choice<FIELD(flow.drive)>({"rate", "pressure-drop", "controlled-pressure"}, 0)},
    Parameter{"flow.rate_ul_per_s", "ul/s", "flow rate through the channel, sheath and sample together",
              number<FIELD(flow.rate_ul_per_s)>({1e-9, 1e3}), has_rate},
    Parameter{"flow.pressure_drop_Pa", "Pa", "pressure drop over channel.length_um, with the cell in it",
              number<FIELD(flow.pressure_drop_Pa)>({1e-6, 1e12}), has_pressure_drop},
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
    Parameter{"cell.viscosity_mPas", "mPa s",
              "viscosity of the cell's interior; a stationary shape does not depend on it",
              number<FIELD(cell.viscosity_mPas)>({1e-3, 1e9}), in_time},
    Parameter{"cell.density_kg_per_m3", "kg/m3", "density of the cell",
              number<FIELD(cell.density_kg_per_m3)>({0, 1e6}, 1000), in_time},
    Parameter{"cell.bulk.law", "", "elastic law of the cell's interior, none: a liquid, which makes the cell a shell",
              choice<FIELD(cell.bulk.law)>({"linear", "neo-hookean", "mooney-rivlin", "none"}, 1)},
    Parameter{"cell.bulk.young_modulus_kPa", "kPa", "Young's modulus of the cell's interior, which is incompressible",
              number<FIELD(cell.bulk.young_modulus_kPa)>({1e-6, 1e9}), has_bulk},
    Parameter{"cell.bulk.mooney_share", "", "share of the neo-hookean law in the mooney-rivlin one, the rest is linear",
              number<FIELD(cell.bulk.mooney_share)>({0, 1}, 0.5), mooney_rivlin},

    Parameter{
        "cell.cortex.law", "", "elastic law of the cell's surface, the cortex",
        choice<FIELD(cell.cortex.law)>({"none", "linear", "thin-shell", "neo-hookean", "neo-hookean-reference"}, 0)},
    Parameter{"cell.cortex.modulus_mN_per_m", "mN/m", "elastic modulus E2D of the cortex, Young's modulus x thickness",
              number<FIELD(cell.cortex.modulus_mN_per_m)>({1e-6, 1e9}), has_shell},
    Parameter{"cell.cortex.tension_mN_per_m",
              "mN/m",
              "surface tension of the cell",
              number<FIELD(cell.cortex.tension_mN_per_m)>({0, 1e9}, 0),
              {},
              "cell.cortex.tension_ratio"},
    Parameter{"cell.cortex.tension_ratio", "", "surface tension as a share of the modulus of the cortex",
              number<FIELD(cell.cortex.tension_ratio)>({0, 1e3}), has_shell, "cell.cortex.tension_mN_per_m"},
    Parameter{"cell.cortex.bending_kBT", "kBT",
              "bending stiffness c_b of the cell's surface in units of k_B T at 25 degrees C (4.116e-21 J)",
              number<FIELD(cell.cortex.bending_kBT)>({0, 1e12}, 0)},

    Parameter{"time.scheme", "",
              "stationary: the final shape at once; monolithic: the way to it, in implicit steps of controlled size; "
              "partitioned: in the splitting of Mokbel et al. 2017",
              choice<FIELD(time.scheme)>({"stationary", "monolithic", "partitioned"}, 0)},
    Parameter{"time.end_us", "us", "time to follow the cell, which starts as a sphere",
              number<FIELD(time.end_us)>({1e-6, 1e12}), in_time},
    Parameter{"time.output_every_us", "us", "time between contours, fields and frames of the animation",
              number<FIELD(time.output_every_us)>({1e-6, 1e12}, 10), in_time},
    Parameter{"time.accuracy", "", "wanted accuracy of the surface's positions in each step, relative to the radius",
              number<FIELD(time.accuracy)>({1e-9, 1e-2}, 1e-5), monolithic},
    Parameter{"time.step_us", "us", "step of the splitting, which is explicit in the elasticity",
              number<FIELD(time.step_us)>({1e-6, 1e6}, 0.2), partitioned},
    Parameter{
        "time.grid_um", "um",
        "size of the elements along the cell's surface, 0.2 in Mokbel et al. 2017; 0: the mesh of the implicit steps",
        number<FIELD(time.grid_um)>({0, 1000}, 0), partitioned},
    Parameter{"time.degree", "", "polynomial degree of the spaces, a whole number",
              number<FIELD(time.degree)>({2, 10}, 6), in_time},

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

bool is_required(const Parameter& parameter) {
  const auto* number = std::get_if<Number>(&parameter.value);
  if (!number || number->fallback) return false;
  const Parameter* other = find_parameter(parameter.alternative);
  return !other || !std::get<Number>(other->value).fallback;
}

bool applies(const Parameter& parameter, const Case& c) {
  const auto& condition = parameter.only_for;
  return !condition || (chosen_option(c, condition->key) == condition->option) != condition->negated;
}

std::string condition_text(const Condition& condition) {
  return fmt::format("{} {} \"{}\"", condition.key, condition.negated ? "other than" : "=", condition.option);
}

std::string allowed_values(const Parameter& parameter) {
  const auto in_range = [&](const Range& range) {
    return fmt::format("{} .. {}{}{}", short_number(range.least), short_number(range.greatest),
                       parameter.unit.empty() ? "" : " ", parameter.unit);
  };
  if (const auto* number = std::get_if<Number>(&parameter.value)) return in_range(number->range);
  if (const auto* list = std::get_if<List>(&parameter.value)) return "a list of numbers " + in_range(list->range);
  std::vector<std::string> quoted;
  for (const auto option : std::get<Choice>(parameter.value).options) quoted.push_back(fmt::format("\"{}\"", option));
  return fmt::format("{}", fmt::join(quoted, " or "));
}

std::string fallback_text(const Parameter& parameter) {
  if (const auto* number = std::get_if<Number>(&parameter.value)) {
    if (number->fallback) return short_number(*number->fallback);
    return is_required(parameter) ? "required" : "not given";
  }
  if (std::holds_alternative<List>(parameter.value)) return "not given";
  const auto& choice = std::get<Choice>(parameter.value);
  return choice.fallback ? fmt::format("\"{}\"", choice.options[static_cast<std::size_t>(*choice.fallback)])
                         : "required";
}

}  // namespace rheocyte

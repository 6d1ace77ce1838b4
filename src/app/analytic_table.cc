#include "app/analytic_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "analytic/isoelasticity.h"
#include "case/case_keys.h"
#include "case/scales.h"
#include "case/user_error.h"
#include "store/build_info.h"
#include "table/table_metadata.h"
#include "table/table_text.h"

namespace rheocyte {

namespace {

// Fraction of the tube's radius where the published lines begin.
constexpr double min_default_ratio = 0.1;

// Under standard conditions (20 um, 0.04 ul/s, 15 mPa s): the range of moduli, and the levels of the published lines.
constexpr double standard_scale_kPa = 15e-3 * 0.04e-9 / (10.94e-6 * 10.94e-6 * 10.94e-6) / 1e3;
constexpr double min_standard_kPa = 0.5, max_standard_kPa = 30;
constexpr std::array standard_levels_kPa{0.93, 1.16, 1.40, 1.67, 1.99, 2.40, 2.93, 3.67, 4.84, 6.94, 12.13};

std::vector<double> evenly_spaced_powers(double first, double last, int count, double power) {
  const double start = std::pow(first, power), end = std::pow(last, power);
  std::vector<double> values;
  values.reserve(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) values.push_back(std::pow(start + (end - start) * i / (count - 1), 1 / power));
  values.front() = first;
  values.back() = last;
  return values;
}

double rounded(double value, int digits) { return std::stod(fmt::format("{:.{}g}", value, digits)); }

void check_order(double least, double greatest, std::string_view what) {
  if (!(least < greatest))
    throw UserError(
        fmt::format("rheocyte: --least-{0} {1:g} is not below --greatest-{0} {2:g}; lower one or raise "
                    "the other.",
                    what, least, greatest));
}

std::vector<double> radius_ratios(const AnalyticTableInput& input) {
  const double R = tube_radius_um(input.conditions.input);
  const double least = input.min_radius_um.value_or(min_default_ratio * R);
  const double greatest = input.max_radius_um.value_or(max_ratio_of_agreement * R);
  const double first = checked_radius_ratio(input.conditions, least, "--least-radius-um");
  const double last = checked_radius_ratio(input.conditions, greatest, "--greatest-radius-um");
  check_order(least, greatest, "radius-um");
  return evenly_spaced_powers(first, last, input.radii, 2);
}

// A modulus and what stands in the file are the same number.
constexpr int digits_of_modulus = 6;

std::vector<double> moduli_kPa(const AnalyticTableInput& input) {
  const double scale = elastic_scale_kPa(input.conditions) / standard_scale_kPa;
  const double least = input.min_modulus_kPa.value_or(rounded(min_standard_kPa * scale, 3));
  const double greatest = input.max_modulus_kPa.value_or(rounded(max_standard_kPa * scale, 3));
  check_order(least, greatest, "modulus-kPa");
  auto moduli = evenly_spaced_powers(least, greatest, input.moduli, -0.5);
  for (double& modulus : moduli) modulus = rounded(modulus, digits_of_modulus);
  return moduli;
}

std::vector<double> levels_kPa(const AnalyticTableInput& input) {
  std::vector<double> levels = input.levels_kPa;
  if (levels.empty()) {
    const double scale = elastic_scale_kPa(input.conditions) / standard_scale_kPa;
    for (const double level : standard_levels_kPa)
      levels.push_back(rounded(level * scale, std::abs(scale - 1) < 1e-9 ? 4 : 3));
  }
  for (double& level : levels) level = rounded(level, digits_of_modulus);
  std::ranges::sort(levels);
  levels.erase(std::unique(levels.begin(), levels.end()), levels.end());
  return levels;
}

// CLI11's own ranges let NaN pass.
void check_numbers(const AnalyticTableInput& input) {
  const Range deformations{1e-6, 0.2};
  if (!deformations.contains(input.max_deformation))
    throw UserError(fmt::format("rheocyte: --max-deformation {:g} is outside its range {:g} .. {:g}.",
                                input.max_deformation, deformations.least, deformations.greatest));
  const auto& modulus = case_key("cell.bulk.young_modulus_kPa");
  for (const double level : input.levels_kPa)
    if (!std::get<Number>(modulus.kind).range.contains(level))
      throw UserError(
          fmt::format("rheocyte: --moduli-kPa {:g} is outside its range {}.", level, allowed_values(modulus)));
}

std::string identifier_of(const AnalyticTableInput& input) {
  if (!input.identifier.empty()) return input.identifier;
  return input.conditions.square_duct ? "LE-2D-ANA-26-duct" : "LE-2D-ANA-26";
}

// Comments and the metadata that dclab reads. No date: equal input gives equal files.
TableText empty_table(const AnalyticTableInput& input, const char* identifier_key) {
  const auto& flow = input.conditions.input.flow;
  TableText table;
  table.comments = {
      fmt::format("{}{}: analytical model of Mietke et al. 2015 for small deformations.", table_mark.substr(2),
                  version),
      fmt::format(
          "A linear elastic sphere in a tube of radius {:g} um, which stands for the square channel; velocity on "
          "the axis",
          tube_radius_um(input.conditions.input)),
      fmt::format("of the {}. Area and deformation are those of the convex contour, without any pixelation.",
                  input.conditions.square_duct ? "square duct" : "tube"),
      fmt::format("Deformations up to {:g}.", input.max_deformation), ""};
  table.metadata = {
      {"authors", "rheocyte"},
      {"channel_width", input.conditions.input.channel.width_um.value()},
      {"channel_width_unit", "um"},
      {"dimensionality", "2Daxis"},
      {"flow_rate", flow.rate_ul_per_s.value()},
      {"flow_rate_unit", "uL/s"},
      {"fluid_viscosity", flow.viscosity_mPas.value()},
      {"fluid_viscosity_unit", "mPa s"},
      {identifier_key, identifier_of(input)},
      {"method", "analytical"},
      {"model", "linear elastic"},
      {"publication", "https://doi.org/10.1016/j.bpj.2015.09.006"},
      {"software", fmt::format("rheocyte {}", version)},
      {"summary", "analytical model of small deformations, linear elastic incompressible sphere in a tube"}};
  return table;
}

TextFile text_of(const AnalyticTableInput& input, const std::vector<double>& moduli, TableText table) {
  IsoelasticityGrid grid{radius_ratios(input), {}, input.max_deformation, input.conditions.duct()};
  for (const double modulus : moduli) grid.capillary_numbers.push_back(elastic_scale_kPa(input.conditions) / modulus);
  const auto lines = isoelasticity_lines(grid);
  const double R = tube_radius_um(input.conditions.input);
  for (std::size_t i = 0; i < lines.size(); ++i)
    for (const auto& point : lines[i]) table.rows.push_back({point.area * R * R, point.deformation, moduli[i]});
  if (table.rows.empty())
    throw UserError(fmt::format(
        "rheocyte: all of these cells deform by more than {:g}; give larger moduli or a larger --max-deformation.",
        input.max_deformation));
  return {{}, to_text(table), int(table.rows.size())};
}

}  // namespace

TextFile analytic_table(const AnalyticTableInput& input) {
  check_numbers(input);
  TextFile file = text_of(input, moduli_kPa(input), empty_table(input, table_identifier_key));
  file.name = fmt::format("lut_{}.txt", identifier_of(input));
  return file;
}

TextFile analytic_lines(const AnalyticTableInput& input) {
  check_numbers(input);
  TextFile file = text_of(input, levels_kPa(input), empty_table(input, lines_identifier_key));
  file.name = fmt::format("iso_{}-area_um-deform.txt", identifier_of(input));
  return file;
}

}  // namespace rheocyte

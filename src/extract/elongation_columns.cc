#include "extract/elongation_columns.h"

#include <fmt/format.h>

#include "numeric/no_value.h"

namespace rheocyte {

std::vector<ElongationColumn> elongation_columns(ElongatedBy by) {
  const bool by_modes = by == ElongatedBy::modes;
  const std::string word = by_modes ? "asymmetry" : "inertia";
  using B = ElongationBlock;
  return {
      {fmt::format("young_modulus_{}_kPa", word), fmt::format("young_modulus_{}", word), "kPa",
       by_modes ? "Young's modulus (kPa) from area, elongation (mode c2) and asymmetry (c3) of the outline, of a solid "
                  "that the liquid draws out, see docs/real-cells.md"
                : "Young's modulus (kPa) from area, deformation and inertia ratio, of a solid that the liquid draws "
                  "out, see docs/real-cells.md",
       &B::modulus_kPa},
      {fmt::format("standard_error_{}_kPa", word), fmt::format("standard error {}", word), "kPa",
       fmt::format("standard error of young_modulus_{} (kPa)", word), &B::standard_error_kPa},
      {"elongation", "elongation", "", "length over width that the liquid's tension alone would give the cell",
       &B::elongation},
      {"axial_tension_Pa", "axial_tension", "Pa",
       "tension of the liquid along the flow (Pa) that elongates the cell so", &B::axial_tension_Pa},
      {"elongation_error", "elongation error", "", "standard error of elongation", &B::elongation_error},
      {"axial_tension_error_Pa", "axial tension error", "Pa", "standard error of axial_tension (Pa)",
       &B::axial_tension_error_Pa}};
}

std::array<std::vector<double>*, 6> ElongationValues::all() {
  return {&modulus_kPa,      &standard_error_kPa, &elongation,
          &elongation_error, &axial_tension_Pa,   &axial_tension_error_Pa};
}

void ElongationValues::assign(std::size_t count) {
  for (auto* const column : all()) column->assign(count, no_value);
  states.assign(count, ModulusState::no_data);
  cells.resize(count);
}

ElongatedEstimates ElongationValues::estimates() {
  return {{modulus_kPa, standard_error_kPa, states},
          elongation,
          elongation_error,
          axial_tension_Pa,
          axial_tension_error_Pa,
          cells};
}

ElongationBlock ElongationValues::block() const {
  return {modulus_kPa, standard_error_kPa, elongation, elongation_error, axial_tension_Pa, axial_tension_error_Pa};
}

void ElongationValues::forget(std::size_t event) {
  for (auto* const column : all()) (*column)[event] = no_value;
}

}  // namespace rheocyte

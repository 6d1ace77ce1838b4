#include "extract/elongation_values.h"

#include "numeric/no_value.h"

namespace rheocyte {

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

void ElongationValues::forget(std::size_t event, ModulusState reason) {
  states[event] = reason;
  for (auto* const column : all()) (*column)[event] = no_value;
}

}  // namespace rheocyte

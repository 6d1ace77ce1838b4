// Moduli of the events of a block, to be computed.
#pragma once
#include <cstddef>
#include <vector>

#include "infer/modulus_map.h"

namespace rheocyte {

/// One value per event.
struct ModulusValues {
  std::vector<double> kPa, standard_error_kPa;
  std::vector<ModulusState> states;

  void resize(std::size_t count) {
    kPa.resize(count);
    standard_error_kPa.resize(count);
    states.resize(count);
  }
  EstimatedModuli estimates() { return {kPa, standard_error_kPa, states}; }
  /// An event has no modulus, for this reason.
  void forget(std::size_t event, ModulusState reason) {
    kPa[event] = standard_error_kPa[event] = no_value;
    states[event] = reason;
  }
};

}  // namespace rheocyte

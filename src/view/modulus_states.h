// What is said about the moduli of events, as GET /api/states lists it.
#pragma once
#include <nlohmann/json.hpp>

namespace rheocyte {

/// [{"number", "name", "has_modulus", "sentence": what is meant}], in the order of the numbers of the column "state".
nlohmann::ordered_json modulus_states();

}  // namespace rheocyte

#include "view/modulus_states.h"

#include "infer/modulus_state.h"

namespace rheocyte {

nlohmann::ordered_json modulus_states() {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (int number = 0; number < int(names_of_modulus_states.size()); ++number) {
    const ModulusState state{number};
    list.push_back({{"number", number},
                    {"name", name_of(state)},
                    {"has_modulus", has_modulus(state)},
                    {"sentence", sentence_of(state)}});
  }
  return list;
}

}  // namespace rheocyte

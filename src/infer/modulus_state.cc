#include "infer/modulus_state.h"

namespace rheocyte {

std::string_view sentence_of(ModulusState state) {
  switch (state) {
    case ModulusState::valid: return "";
    case ModulusState::no_data: return "Area, deformation or viscosity of this event is not known.";
    case ModulusState::too_small: return "The cell is smaller than any cell of the table at this channel width.";
    case ModulusState::too_large: return "The cell is larger than any cell of the table at this channel width.";
    case ModulusState::too_stiff: return "The cell is deformed less than the stiffest cell of the table of this area.";
    case ModulusState::too_soft: return "The cell is deformed more than the softest cell of the table of this area.";
    case ModulusState::unstable: return "The bare surface of such a soft cell wrinkles: there is no smooth state.";
    case ModulusState::unresolved:
      return "The standard error is greater than the modulus, or the table has a gap here.";
    case ModulusState::regularised: return "The modulus is that of a cell whose surface is held smooth by bending.";
    case ModulusState::gated: return "The event lies outside the gates.";
    case ModulusState::too_round: return "The cell is flatter along the flow than any cell of the table.";
    case ModulusState::too_elongated: return "The cell is longer along the flow than any cell of the table.";
    case ModulusState::inertial: return "The inertia of the liquid, which the table neglects, changes this modulus.";
    case ModulusState::cut: return "The outline touches the edge of the picture: it is not that of the whole cell.";
  }
  return "";
}

}  // namespace rheocyte

// The media of RT-DC by the names under which recordings and people know them.
#pragma once
#include <optional>
#include <string>
#include <string_view>

namespace rheocyte {

/// Liquids with a known viscosity: methyl cellulose in phosphate-buffered saline, and water.
enum class Medium { methyl_cellulose_049, methyl_cellulose_059, methyl_cellulose_083, water };

/// The medium of a recording's metadata. Capitals, blanks, "_", "-" and decimal commas do not count, and a solution of
/// methyl cellulose is known by its percentage: "CellCarrier", "Cell Carrier B", "0.49% MC-PBS", "0.5%", "0,60 % (w/v)
/// MC in PBS", "water", ...; nothing for any other name.
std::optional<Medium> medium_of_name(std::string_view name);

/// The concentration's usual name, e.g. "0.49% MC-PBS".
std::string_view name_of(Medium medium);

/// For a name that is not known: ", did you mean ...?", by the percentage where there is one; empty if nothing is near.
std::string near_medium(std::string_view name);

}  // namespace rheocyte

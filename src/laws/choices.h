// Which law: the enumerations alone, for all that name a law and compute nothing with it.
#pragma once

namespace rheocyte {

/// `linear` is the Euler-Almansi law of Mokbel et al. 2017, the pure c2 member of the Mooney-Rivlin family;
/// `neo_hookean` is the pure c1 member. `fung` stiffens exponentially with the strain. `none`: no elastic interior but
/// a liquid at rest, a pure shell.
enum class BulkLaw { linear, neo_hookean, mooney_rivlin, fung, none };

/// Elastic laws of the cell's surface: `linear`, `thin_shell`, `neo_hookean` are those of Mokbel et al. 2017;
/// `neo_hookean_reference` is the usual membrane law with its energy per reference area, `skalak` that of red blood
/// cells' membranes, which stiffens where the others soften.
enum class CortexLaw { none, linear, thin_shell, neo_hookean, neo_hookean_reference, skalak };

enum class LiquidLaw { newtonian, power_law, carreau };

/// Whether the viscosity is a power of the shear rate: then flows of all rates are one, and a table scales between
/// them.
inline bool is_power_law(LiquidLaw law) { return law == LiquidLaw::newtonian || law == LiquidLaw::power_law; }

}  // namespace rheocyte

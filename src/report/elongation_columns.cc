#include "report/elongation_columns.h"

#include <fmt/format.h>

namespace rheocyte {

std::vector<ElongationColumn> elongation_columns(ElongatedBy by) {
  const bool by_modes = by == ElongatedBy::modes;
  using B = ElongationBlock;
  const std::string modulus = fmt::format("young_modulus_{}_kPa", by_modes ? "asymmetry" : "inertia");
  std::vector<ElongationColumn> columns{
      {{modulus, "kPa", "E as of an elongated cell",
        by_modes ? "Young's modulus (kPa) from area, elongation (mode c2) and asymmetry (c3) of the outline, of a "
                   "solid elongated by the liquid, see docs/real-cells.md"
                 : "Young's modulus (kPa) from area, deformation and inertia ratio, of a solid elongated by the "
                   "liquid, see docs/real-cells.md"},
       &B::modulus_kPa},
      {{modulus + "_error", "kPa", "Standard error of E as of an elongated cell", "standard error of " + modulus},
       &B::standard_error_kPa},
      {{"elongation", "", "Elongation by the axial tension",
        "length over width that only the tension of the liquid would give the cell"},
       &B::elongation},
      {{"axial_tension_Pa", "Pa", "Axial tension of the liquid",
        "tension of the liquid along the flow (Pa) that elongates the cell this much"},
       &B::axial_tension_Pa},
      {{"elongation_error", "", "Standard error of the elongation", "standard error of elongation"},
       &B::elongation_error,
       true},
      {{"axial_tension_Pa_error", "Pa", "Standard error of the axial tension", "standard error of axial_tension_Pa"},
       &B::axial_tension_error_Pa,
       true}};
  for (ElongationColumn& column : columns) column.role = column.name;
  return columns;
}

}  // namespace rheocyte

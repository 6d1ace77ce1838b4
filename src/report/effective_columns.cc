#include "report/effective_columns.h"

#include <array>

namespace rheocyte {

namespace {

using E = EffectiveCell;

std::string_view place_word(const E& e) {
  constexpr std::array<std::string_view, 7> words{"",        "inside",     "softer",   "longer",
                                                  "stiffer", "other size", "ambiguous"};
  return words.at(static_cast<std::size_t>(e.place));
}

}  // namespace

Columns<E> effective_columns() {
  ColumnList<E> list;
  const auto add = [&](const char* name, std::string_view unit, const char* label, const char* sentence,
                       Median E::*median) {
    list.add_with_errors(
        {name, unit, label, sentence, "", 0, digits_of_values}, [median](const E& e) { return (e.*median).value; },
        [median](const E& e) { return (e.*median).error; }, [median](const E& e) { return (e.*median).common_error; });
  };
  add("effective_modulus_kPa", "kPa", "Effective Young's modulus",
      "modulus of the homogeneous solid that a small axial tension elongates as the cell with the median area, "
      "deformation and inertia ratio",
      &E::effective_kPa);
  add("cell_stiffness_kPa", "kPa", "E + E2D/r0", "of that cell, with the proportions of HL60 cells", &E::stiffness_kPa);
  add("cell_young_modulus_kPa", "kPa", "E of the bulk", "of that cell", &E::young_kPa);
  add("cell_cortex_modulus_mN_per_m", "mN/m", "E2D of the cortex", "of that cell", &E::cortex_mN_per_m);
  add("cell_cortex_tension_mN_per_m", "mN/m", "Tension of the cortex", "of that cell", &E::tension_mN_per_m);
  add("cell_axial_tension_Pa", "Pa", "Axial tension of the liquid", "that elongates that cell", &E::axial_tension_Pa);
  list.add({"cell_axial_tension_over_wall_stress", "", "Axial tension over the wall shear stress", "of that cell"},
           [](const E& e) { return e.axial_tension_Pa.value / e.wall_stress_Pa; })
      .add({"cell_radius_um", "um", "Radius at rest", "of that cell"}, &E::radius_um)
      .add({"effective_modulus_over_other_law", "", "Effective modulus over that by the other law",
            "by a cortex with an energy per current area over that by one with an energy per reference area"},
           &E::over_other_law)
      .add_with_error(
          {"effective_modulus_large_over_small", "", "Effective modulus of large over small cells",
           "of the third of the events with the largest areas over the third with the smallest", "", 0,
           digits_of_values},
          [](const E& e) { return e.large_over_small_modulus.value; },
          [](const E& e) { return e.large_over_small_modulus.error; })
      .add_with_error(
          {"axial_tension_large_over_small", "", "Axial tension of large over small cells",
           "of the same cells; the model has one tension for all sizes", "", 0, digits_of_values},
          [](const E& e) { return e.large_over_small_tension.value; },
          [](const E& e) { return e.large_over_small_tension.error; })
      .add({"effective_modulus_share_percent", "%", "Events with an effective modulus",
            "of the events that have one under that axial tension, or lie on a known side of the table"},
           [](const E& e) { return e.events_kPa.all() > 0 ? 100 * e.events_kPa.share() : no_value; })
      .add_with_error(
          {"effective_modulus_of_events_median_kPa", "kPa", "Effective modulus of the events, median",
           "of all events under that axial tension; those beyond the table count on their side", "", 0,
           digits_of_values},
          [](const E& e) { return e.events_kPa.value; }, [](const E& e) { return e.events_kPa.error; });
  list.add({"effective_place", "", "Place in the table of cells with a cortex",
            "\"inside\", \"softer\", \"longer\", \"stiffer\", \"other size\" or \"ambiguous\""},
           place_word);
  return std::move(list).columns();
}

}  // namespace rheocyte

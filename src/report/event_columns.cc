#include "report/event_columns.h"

#include <fmt/format.h>

#include <iterator>

#include "report/elongation_columns.h"

namespace rheocyte {

namespace {

/// Among the free names of companions.
enum Rank {
  rank_of_state = 1,
  rank_of_effective,
  rank_of_error,
  rank_of_elongation,
  rank_of_shapes,
  rank_of_tilt,
  rank_of_last_errors
};

std::string meaning_of_states() {
  std::string text = "state of emodulus:";
  for (std::size_t k = 0; k < states_by_deformation().size(); ++k)
    text += fmt::format("{} {} {}", k == 0 ? "" : ",", k, states_by_deformation()[k]);
  return text + fmt::format(", {} {}", int(ModulusState::cut), name_of(ModulusState::cut));
}

std::string label_of(std::string_view tilt) {
  constexpr std::string_view sine = "sine_mode_";
  return tilt.starts_with(sine) ? fmt::format("Sine mode s{} of the outline", tilt.substr(sine.size()))
                                : "Slope of the flanks";
}

void add_shapes(ColumnsOf<EventBlock>& columns) {
  const auto of = [](auto number) { return of_each(&EventBlock::shape, number); };
  const ColumnsOf<EventBlock> of_shapes{
      {{"shape_excess", "", "Shape excess",
        "inertia ratio - that of the table's cell of this area and deformation; elongated: above 0.05", "shape_excess",
        rank_of_shapes},
       of(&ShapeExcess::excess)},
      {{"shape_excess_error", "", "Standard error of the shape excess", "standard error of shape_excess"},
       of(&ShapeExcess::error)},
      {{.name = "elongated",
        .label = "Elongated",
        .sentence = "whether the cell is longer along the flow than that of the table",
        .is_flag = true},
       of(&ShapeExcess::is_elongated)},
      {{"odd_fraction", "", "Odd fraction of the outline",
        "fraction of the deformation that is not that of an ellipse of this inertia ratio", "odd_fraction",
        rank_of_shapes},
       of(&ShapeExcess::odd_fraction)}};
  columns.insert(columns.end(), of_shapes.begin(), of_shapes.end());
}

void add_tilt(ColumnsOf<EventBlock>& columns) {
  for (const TiltFeature& feature : tilt_features())
    columns.push_back({{feature.name, "", label_of(feature.name), feature.sentence, feature.name, rank_of_tilt},
                       of_each(&EventBlock::tilt, feature.value)});
}

void add_effective(ColumnsOf<EventBlock>& columns) {
  const ColumnsOf<EventBlock> of_cells{
      {{"effective_modulus_kPa", "kPa", "Effective Young's modulus",
        "effective Young's modulus of the cell under the axial tension of the recording", "effective_modulus_kPa",
        rank_of_effective},
       stored(&EventBlock::effective_modulus_kPa)},
      {{"effective_modulus_kPa_error", "kPa", "Standard error of the effective modulus",
        "of pixels, table and inertia; the axial tension is taken as known"},
       stored(&EventBlock::effective_error_kPa)},
      {{.name = "effective_state",
        .label = "State of the effective modulus",
        .sentence = "whether there is an effective modulus, or why there is none",
        .words = names_of_modulus_states},
       of_each(&EventBlock::effective_state, [](ModulusState state) { return int(state); })}};
  columns.insert(columns.end(), of_cells.begin(), of_cells.end());
}

}  // namespace

ColumnsOf<EventBlock> event_columns(const EventKnowledge& known) {
  using B = EventBlock;
  ColumnsOf<B> columns{
      {{"area_um2", "um2", "Area", "area of the convex hull"}, stored(&B::area_um2)},
      {{"deformation", "", "Deformation", "1 - circularity of the convex hull"}, stored(&B::deformation)},
      {{"viscosity_mPas", "mPa s", "Viscosity", "viscosity of the liquid"}, stored(&B::viscosity_mPas)},
      {{"young_modulus_kPa", "kPa", "E from deformation", "Young's modulus", "emodulus"},
       stored(&B::young_modulus_kPa)}};
  if (known.errors)
    columns.push_back(
        {{"young_modulus_kPa_error", "kPa", "Standard error of E",
          "standard error of emodulus (kPa), of pixels, table and inertia", "young_modulus_kPa_error", rank_of_error},
         stored(&B::standard_error_kPa)});
  columns.push_back({{.name = "state",
                      .label = "State of the modulus",
                      .sentence = meaning_of_states(),
                      .role = "state",
                      .rank = rank_of_state,
                      .words = names_of_modulus_states},
                     of_each(&B::state, [](ModulusState state) { return int(state); })});
  if (known.effective) add_effective(columns);
  if (known.shapes) add_shapes(columns);
  if (known.asymmetry)
    columns.push_back({{"mode_3", "", "Mode c3 of the outline",
                        "cosine mode c_3 of the hull's radius, of a cell that moves along +x"},
                       stored(&B::mode_3)});
  if (known.elongated_by)
    for (ElongationColumn& column : elongation_columns(*known.elongated_by)) {
      column.rank = column.is_error_of_elongation ? rank_of_last_errors : rank_of_elongation;
      columns.push_back({column, column.values_in<B>()});
    }
  if (known.asymmetry) add_tilt(columns);
  return columns;
}

std::vector<ColumnDescription> companion_columns() {
  std::vector<ColumnDescription> all;
  for (const auto by : {ElongatedBy::modes, ElongatedBy::inertia})
    for (const auto& column : event_columns({true, true, true, by, true}))
      if (!column.role.empty() && std::ranges::find(all, column.role, &ColumnDescription::role) == all.end())
        all.push_back(column);
  std::ranges::stable_sort(all, {}, &ColumnDescription::rank);
  return all;
}

}  // namespace rheocyte

#include "view/combined_cells.h"

#include <array>
#include <cmath>

#include "case/write_case.h"
#include "report/moduli_columns.h"
#include "report/rows_json.h"
#include "shelf/square_section.h"
#include "view/event_json.h"
#include "view/model_outline.h"

namespace rheocyte {

namespace {

using Json = nlohmann::ordered_json;

/// Whether the estimate is a cell of the table.
bool is_cell(const ModuliEstimate& estimate) {
  switch (estimate.status) {
    case ModuliStatus::resolved:
    case ModuliStatus::not_told_apart:
    case ModuliStatus::poor_fit: return true;
    default: return false;
  }
}

Json numbers_of(const ModuliEstimate& e) {
  Json j{{"status", name_of(e.status)}, {"sentence", sentence(e)}};
  BlockValues<ModuliBlock> values(estimate_columns());
  ModuliBlock block;
  block.estimates = {&e, 1};
  const auto numbers = values.of(block);
  for (std::size_t k = 0; k < numbers.size(); ++k)
    if (const ColumnDescription& column = values.columns()[k]; column.words.empty())
      j[column.name] = value_json(column, numbers[k][0]);
  return j;
}

}  // namespace

CombinedCells::CombinedCells(const Recording& recording, const MeasuringOptions& measuring, const ModuliTables& tables)
    : events_(recording, measuring, {.outlines = OutlineUse::needed, .outlines_for = use_of_outlines}),
      section_(section_seen({}, events_.facts().made_of, tables.computed().content.spec.base)),
      table_(tables.seen_in(section_, events_.conditions().flow.exponent, events_.facts().made_of)),
      moduli_(events_.settings(), {}, table_, section_) {
  events_.turn_downstream(table_.sign_of_asymmetry());
}

CombinedCell CombinedCells::at(std::size_t event) {
  std::array<double, 1> viscosity_mPas{};
  events_.settings().viscosities(events_.recording(), event, viscosity_mPas);
  ModuliEstimate estimate = moduli_.fit(events_.shape(event), viscosity_mPas[0]);
  if (estimate.status == ModuliStatus::no_data && events_.is_cut(event)) estimate.status = ModuliStatus::cut;
  CombinedCell cell{numbers_of(estimate), {}};
  cell.told["table"] = table_.content.spec.identifier;
  cell.told["case"] = nullptr;
  if (!is_cell(estimate)) return cell;
  cell.told["case"] = case_of(estimate, viscosity_mPas[0]);
  cell.outline = outline_of(estimate);
  return cell;
}

/// The live solver's case of this cell, in the channel of the recording.
Json CombinedCells::case_of(const ModuliEstimate& estimate, double viscosity_mPas) const {
  ChannelFlow flow = events_.settings().conditions.flow;
  flow.viscosity_mPas = viscosity_mPas;
  flow.exponent = table_.simulated.exponent;
  const double length = scale_factors(table_.simulated, flow).length;
  const SweepPoint place{length * std::exp(estimate.cell(x_radius)), estimate.cell(x_fraction), estimate.cell(x_ratio)};
  const Json cell = to_json(case_at(table_.content.spec, place, estimate.stiffness_kPa));
  Json in_flow = flow_json(flow);
  if (table_.between.is_elongated()) in_flow["axial_tension_Pa"] = estimate.axial_tension_Pa;
  return {{"channel", {{"width_um", flow.width_um}}}, {"flow", in_flow}, {"cell", cell["cell"]}};
}

Eigen::MatrixX2d CombinedCells::outline_of(const ModuliEstimate& estimate) const {
  const CombinedState state = table_.between.at(estimate.cell);
  std::array<double, mode_count> modes{};
  for (int k = 0; k < mode_count; ++k) modes[std::size_t(k)] = state.value(first_mode_row + k);
  const double area = scale_factors(table_.simulated, events_.settings().conditions.flow).area;
  return outline_about_centroid(modes, area * std::exp(state.value(log_area_row)));
}

}  // namespace rheocyte

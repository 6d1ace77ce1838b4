// What an extraction says of all events of its recording.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "events/event_pass.h"
#include "events/plausibility.h"
#include "events/settings_hash.h"
#include "extract/common_errors.h"
#include "extract/extraction.h"
#include "extract/fitting_table.h"
#include "extract/soft_ends.h"
#include "extract/virtual_cells.h"
#include "numeric/quantile.h"

namespace rheocyte {

namespace {

std::string corrected_for_pixels(const MeasuringConditions& conditions, const ModulusMap& table) {
  if (conditions.pixel_size_um == 0) return "nothing";
  return table.is_rheocyte_table() && conditions.correct_area ? "area and deformation" : "deformation";
}

/// What the medians have in common with those of other recordings, beside the scatter of the events.
void add_common_errors(ExtractSummary& s) {
  ChannelFlow flow = s.conditions.flow;
  flow.viscosity_mPas = s.mean_viscosity_mPas;
  const double reynolds = reynolds_number(buffer_density_kg_per_m3, flow);
  JudgedModulus& by_deformation = s.shapes.by_deformation;
  by_deformation.common_error =
      common_error_by_deformation(s.median_standard_error_kPa / s.modulus_kPa.median, reynolds);
  // Of a few events the scatter says less than the error of each.
  by_deformation.least_error_kPa =
      s.median_standard_error_kPa * std::sqrt(std::numbers::pi / 2 / double(s.with_modulus()));
  const ElongatedBy by = s.shapes.elongated_by;
  s.shapes.by_elongation.common_error = common_error_of_elongated(by, reynolds);
  if (s.shapes.with_elongation == 0) return;
  s.shapes.elongation.common_error = common_error_of_elongation();
  const double modulus_Pa = 1e3 * s.shapes.elongated_kPa.median;
  s.shapes.axial_tension_Pa.common_error = common_error_of_tension_ratio(by) * modulus_Pa;
}

}  // namespace

ExtractSummary Extraction::summary() {
  ExtractSummary s = summary_;
  events_.turn(event_shapes_.direction());
  static_cast<RecordingFacts&>(s) = events_.facts();
  s.modulus_kPa = distribution_of(moduli_);
  s.mean_viscosity_mPas = viscosity_sum_ / static_cast<double>(viscosities_);
  s.median_standard_error_kPa = median_of(standard_errors_);
  s.table = table().origin().identifier;
  s.settings_hash = settings_hash();
  s.corrected = corrected_for_pixels(conditions(), table());
  s.shapes = shape_tally_.verdict(s.pixel_size_um);
  s.shapes.inertia_ratio_from = event_shapes_.inertia_ratio_from();
  s.shapes.direction = s.direction;
  s.shapes.beside_axis = shape_tally_.beside_axis(s.direction, conditions().flow);
  s.shapes.missing = event_shapes_.missing();
  if (const ShapeMap* const map = event_shapes_.map()) s.shapes.model = map->origin().cells();
  s.shapes.made_of = cells_made_of(events_.facts().made_of, events_.recording().metadata(), tables_, table(),
                                   conditions().flow.exponent);
  s.shapes.elongated_by = event_shapes_.elongated_by().value_or(ElongatedBy::modes);
  s.shapes.is_tension_given = tension_.is_known();
  s.shapes.are_shapes_gated = events_.gates().limit_shapes();
  s.shapes.without_shape_gates_kPa = without_shape_gates_kPa_;
  s.shapes.has_elongated_table = event_shapes_.elongated_by().has_value();
  add_common_errors(s);
  add_soft_ends(s);
  if (s.shapes.fit() != ShapeVerdict::Fit::unknown && s.shapes.fit() != ShapeVerdict::Fit::model)
    s.shapes.other = fitting_table(tables_, conditions(), shape_tally_.judged());
  if (effective_map_)
    add_effective_events(s);
  else if (s.shapes.has_effective_modulus())
    add_effective_cell(s);
  s.warnings = remarks(s);
  if (const auto beyond = beyond_the_square(); !beyond.empty()) s.warnings.push_back(beyond);
  if (s.shapes.are_shapes_gated)
    if (const auto gates = gates_on_shapes(s.shapes); !gates.empty()) s.warnings.push_back(gates);
  if (comparison_.is_made()) s.warnings.push_back(comparison_.sentence(conditions().flow.exponent));
  if (events_.recording().has_scalar("emodulus"))
    s.warnings.emplace_back("the recording has a feature emodulus of another program; it was not used.");
  return s;
}

/// Cells are then selected by what their stiffness decides.
std::string Extraction::gates_on_shapes(const ShapeVerdict& shapes) const {
  constexpr double worth_a_word = 0.01;  // of the modulus
  const Recommendation r = recommendation(shapes);
  if (r.way == RecommendedWay::none) return {};
  if (std::abs(std::log(r.kPa.value / shapes.without_shape_gates_kPa)) < worth_a_word) return {};
  const std::string gates = fmt::format("the gates ({}) select cells by their shape.", events_.gates().description());
  if (!std::isfinite(shapes.without_shape_gates_kPa))
    return gates + " The recommended modulus is that of the selected cells: without these gates there is none.";
  return fmt::format(
      "{} Without gates on the shape the recommended modulus is {:.4g} kPa; the difference is part of "
      "the systematic error.",
      gates, shapes.without_shape_gates_kPa);
}

void Extraction::add_effective_cell(ExtractSummary& s) const {
  ChannelFlow flow = conditions().flow;
  flow.viscosity_mPas = s.mean_viscosity_mPas;
  s.shapes.effective = effective_cell(tables_.proportioned(flow.exponent), shape_tally_.figures(),
                                      {flow, tables_.section()}, conditions().pixel_size_um, tension_);
  add_errors_of_model(reynolds_number(buffer_density_kg_per_m3, flow), s.shapes.has_cortex_shapes(),
                      s.shapes.effective);
  if (s.shapes.is_tension_given) s.shapes.effective.axial_tension_Pa = {.value = tension_.value_Pa};
}

void Extraction::add_effective_events(ExtractSummary& s) const {
  s.shapes.effective = effective_cell_;
  s.shapes.effective.events_kPa = effective_moduli_.judged().median_kPa;
}

// Where moduli end in the tables, for a bound of a median beyond them.
void Extraction::add_soft_ends(ExtractSummary& s) const {
  const SofterCells softer = shape_tally_.softer();
  s.shapes.by_deformation.soft_end_kPa =
      softest_modulus_kPa(table(), conditions(), softer.area_um2, s.mean_viscosity_mPas);
  if (const ElongatedLiquid* const elongated = event_shapes_.elongated_table())
    s.shapes.by_elongation.soft_end_kPa =
        softest_modulus_kPa(*elongated, conditions(), softer.elongated, s.mean_viscosity_mPas);
}

// Where many cells are softer than the table's last ones.
std::string Extraction::beyond_the_square() const {
  constexpr double worth_a_word = 0.01;
  const auto count = [this](ModulusState state) { return summary_.counts[static_cast<std::size_t>(state)]; };
  const auto beyond = static_cast<double>(count(ModulusState::unstable) + count(ModulusState::too_soft));
  const double fraction = beyond / static_cast<double>(events_.facts().recorded);
  if (!are_square_ || fraction < worth_a_word) return {};
  return fmt::format(
      "{:.0f} % of the events are deformed beyond the smooth shapes of {}; the tables of the tube reach farther "
      "(section tube).",
      100 * fraction, table().origin().identifier);
}

std::vector<std::string> Extraction::lines() const {
  std::vector<std::string> lines{
      fmt::format("table: {}", table().origin().description()),
      fmt::format("area from {}, deformation from {}", shapes().area_from(), shapes().deformation_from()),
      fmt::format("corrected for pixels: {}", corrected_for_pixels(conditions(), table()))};
  const RecordingFacts& facts = events_.facts();
  lines.insert(lines.end(), facts.settings.begin(), facts.settings.end());
  if (effective_map_)
    lines.push_back(fmt::format("effective moduli of events: under an axial tension of {:.4g} Pa, table {}",
                                effective_cell_.axial_tension_Pa.value, effective_map_->origin().identifier));
  if (!facts.gates.empty()) lines.push_back("only events with " + facts.gates);
  lines.push_back("settings hash: " + settings_hash());
  return lines;
}

std::string Extraction::settings_hash() const {
  std::vector<std::string> lines = events_.facts().decisive;
  lines.push_back(decisive_line(table().origin()));
  lines.push_back(fmt::format("area from {}, deformation from {}", shapes().area_from(), shapes().deformation_from()));
  if (const ElongatedLiquid* const elongated = event_shapes_.elongated_table())
    lines.push_back(fmt::format("elongated cells by {}, {}",
                                event_shapes_.elongated_by() == ElongatedBy::modes ? "outlines" : "inertia ratio",
                                decisive_line(elongated->solids().origin())));
  if (tension_.is_known()) lines.push_back(fmt::format("axial tension: {} Pa", tension_.value_Pa));
  return rheocyte::settings_hash(lines);
}

double without_shape_gates_kPa(const Recording& recording, const ExtractOptions& options, const ModulusTables& tables,
                               EventPass& events) {
  if (!Gates(options.measuring.gates).limit_shapes()) return no_value;
  ExtractOptions lifted = options;
  lifted.measuring.lifts_shape_gates = true;
  Extraction all(recording, lifted, tables);
  events.in_blocks(all.block(), [&](std::size_t first, std::size_t count) { all.compute(first, count); });
  const Recommendation r = recommendation(all.summary().shapes);
  return r.way == RecommendedWay::none ? no_value : r.kPa.value;
}

ExtractSummary summary_of_recording(const std::filesystem::path& file, const ExtractOptions& options,
                                    const ModulusTables& tables, const TellProgress& on_progress) {
  Recording recording(file);
  EventPass pass(recording, on_progress);
  const double without_gates = without_shape_gates_kPa(recording, options, tables, pass);
  Extraction extraction(recording, options, tables);
  extraction.take_without_shape_gates(without_gates);
  pass.in_blocks(extraction.block(), [&](std::size_t first, std::size_t count) { extraction.compute(first, count); });
  return extraction.summary();
}

}  // namespace rheocyte

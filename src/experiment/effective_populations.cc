#include "experiment/effective_populations.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "case/user_error.h"
#include "events/plausibility.h"
#include "experiment/tension_of_setup.h"
#include "extract/effective_words.h"

namespace rheocyte {
namespace {

EventFigures figures_of(const PopulationEvents& events) {
  EventFigures figures;
  figures.has_ratios = events.has_inertia_ratios;
  for (std::size_t i = 0; i < events.events(); ++i)
    figures.take(events.of(SeenMeasure::area_um2)[i], events.of(SeenMeasure::deformation)[i],
                 figures.has_ratios ? events.of(SeenMeasure::inertia_ratio)[i] : no_value);
  return figures;
}

ChannelFlow flow_of(const RecordingReport& r) {
  ChannelFlow flow = r.conditions.flow;
  flow.viscosity_mPas = r.median_viscosity_mPas;
  return flow;
}

QuantityEstimate estimate_of(PopulationQuantity quantity, const Median& median, double spread) {
  return {quantity,
          {std::log(median.value), std::pow(median.error / median.value, 2)},
          spread,
          median.common_error / median.value};
}

}  // namespace

EffectivePopulations::EffectivePopulations(const PopulationOptions& options)
    : tables_(std::string(), options.section.value_or(Section::square)),
      given_(AxialTension::given(options.axial_tension_Pa)) {
  if (!options.by.empty())
    throw UserError(
        fmt::format("rheocyte: --by {} and --model effective contradict each other: the effective modulus follows from "
                    "area, deformation and inertia ratio. Leave --by out.",
                    options.by));
  if (!options.table.empty())
    throw UserError("rheocyte: --table is not for --model effective, which takes the tables of the program.");
  if (!tables_.proportioned(1).in_liquid)
    throw UserError(
        "rheocyte: the tables of --model effective (combined_HL-2D-NH-26.cbor) are missing; install the program "
        "again.");
}

std::string EffectivePopulations::systematic_errors(std::span<const RecordingReport> recordings) const {
  double greatest = 0;
  for (const RecordingReport& r : recordings)
    if (const QuantityEstimate* e = r.estimate(PopulationQuantity::effective_modulus))
      greatest = std::max(greatest, e->common_error);
  return fmt::format(
      "pixels, section, table, proportions and law of the cortex, cells off the axis in height {:.2g} % of {}; "
      "viscosity model as docs/verification.md has it",
      100 * greatest, words_of(PopulationQuantity::effective_modulus).symbol);
}

void EffectivePopulations::fit(const PopulationEvents& events, RecordingReport& r, const Watch&) {
  EventFigures figures = figures_of(events);
  r.fitted_events = figures.area_um2.size();
  check_events_of_population(r);
  const bool has_tension = figures.has_ratios || given_.is_known();
  if (has_tension)
    take_cell(figures, given_, r);
  else
    r.failure =
        "there are neither outlines nor inertia ratios (inert_ratio_cvx): the axial tension of the liquid is unknown. "
        "Give it with --axial-tension-Pa, or analyse two recordings of the same medium, channel and flow rate together "
        "with this one.";
  without_ratios_.push_back(has_tension ? EventFigures{} : std::move(figures));
}

void EffectivePopulations::share(std::span<RecordingReport> recordings) {
  for (std::size_t k = 0; k < recordings.size(); ++k) {
    RecordingReport& r = recordings[k];
    if (without_ratios_[k].area_um2.empty()) continue;
    const auto tension = tension_of_setup(recordings, r);
    if (!tension) continue;
    const double Pa = std::exp(tension->log_over_wall_stress) * r.wall_stress_Pa();
    r.failure.clear();
    take_cell(without_ratios_[k], {Pa, Pa * tension->deviation}, r);
    r.warnings.push_back(fmt::format(
        "there are neither outlines nor inertia ratios: the axial tension, {:.0f} Pa, is that of the other recordings "
        "of the same medium, channel and flow rate.",
        Pa));
  }
}

EffectiveCell EffectivePopulations::cell_of(const EventFigures& figures, const AxialTension& tension,
                                            const RecordingReport& r) const {
  const ChannelFlow flow = flow_of(r);
  return effective_cell(tables_.proportioned(flow.exponent), figures, {flow, tables_.section()}, r.pixel_size_um,
                        tension);
}

void EffectivePopulations::compare(const PopulationEvents& without_shape_gates, RecordingReport& r) const {
  if (!r.effective || !r.effective->is_found()) {
    r.warnings.emplace_back("the gates select cells by their shape: a modulus is that of the selected cells.");
    return;
  }
  const EffectiveCell all = cell_of(figures_of(without_shape_gates), given_, r);
  if (!all.is_found()) {
    r.warnings.emplace_back(
        "the gates select cells by their shape: the effective modulus is that of the selected cells. Without gates on "
        "the shape there is none: " +
        effective_place_text(all));
    return;
  }
  constexpr double worth_a_word = 0.01;  // of the modulus
  if (std::abs(std::log(all.effective_kPa.value / r.effective->effective_kPa.value)) < worth_a_word) return;
  const auto add = [&](PopulationQuantity quantity, const Median& selected, const Median& of_all) {
    for (QuantityEstimate& e : r.quantities)
      if (e.quantity == quantity) e.common_error = std::hypot(e.common_error, std::log(of_all.value / selected.value));
  };
  add(PopulationQuantity::effective_modulus, r.effective->effective_kPa, all.effective_kPa);
  add(PopulationQuantity::axial_tension, r.effective->axial_tension_Pa, all.axial_tension_Pa);
  r.warnings.push_back(fmt::format(
      "the gates select cells by their shape. Without gates on the shape the effective modulus is {:.3g} kPa; the "
      "difference is part of the systematic error, and ratios of such recordings are too close to 1.",
      all.effective_kPa.value));
}

void EffectivePopulations::take_cell(const EventFigures& figures, const AxialTension& tension,
                                     RecordingReport& r) const {
  const ChannelFlow flow = flow_of(r);
  EffectiveCell& cell = r.effective.emplace(cell_of(figures, tension, r));
  if (!cell.is_found()) {
    r.failure = effective_place_text(cell);
    r.is_beyond = cell.place == EffectivePlace::softer || cell.place == EffectivePlace::longer;
    if (std::isfinite(cell.softest_kPa) && cell.place == EffectivePlace::softer)
      r.bound = {PopulationQuantity::effective_modulus, std::log(cell.softest_kPa)};
    return;
  }
  add_errors_of_model(reynolds_number(buffer_density_kg_per_m3, flow), false, cell);
  r.quantities = {estimate_of(PopulationQuantity::effective_modulus, cell.effective_kPa, cell.spread)};
  if (!tension.is_known())
    r.quantities.push_back(estimate_of(PopulationQuantity::axial_tension, cell.axial_tension_Pa, 0));
  if (std::string text = by_ratios_text(cell); !text.empty()) r.warnings.push_back(std::move(text));
  r.log_radius = std::log(cell.radius_um);
}

}  // namespace rheocyte

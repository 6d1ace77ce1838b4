#include "extract/extraction.h"

#include <algorithm>
#include <cmath>

#include "extract/event_errors.h"
#include "infer/cells_under_tension.h"
#include "infer/grid_map.h"
#include "numeric/no_value.h"

namespace rheocyte {

namespace {

constexpr std::size_t block_of_scalars = 1 << 15;   // its columns stay in fast memory; chunks of 1 MiB are kept by HDF5
constexpr std::size_t block_of_outlines = 1 << 12;  // progress stays visible when every event takes microseconds

PixelUse pixel_use(const ExtractOptions& options) {
  if (options.no_pixelation) return PixelUse::ignore;
  return options.no_area_correction ? PixelUse::correct_deformation : PixelUse::correct;
}

EventShapes::Tables shape_tables(const ModulusTables& tables, double flow_exponent) {
  return {tables.shapes(flow_exponent), tables.elongated(flow_exponent)};
}

}  // namespace

Extraction::Extraction(const Recording& recording, const ExtractOptions& options, const ModulusTables& tables)
    : tables_(tables),
      events_(recording, options.measuring, {.pixels = pixel_use(options)}),
      table_(tables.used(conditions().flow.exponent)),
      comparison_(table_, tables.other(conditions().flow.exponent)),
      tension_(AxialTension::given(options.axial_tension_Pa)),
      are_square_(tables.are_square()),
      event_shapes_(recording, conditions(),
                    EventShapes::are_measured(recording) ? shape_tables(tables, conditions().flow.exponent)
                                                         : EventShapes::Tables{},
                    !options.no_asymmetry) {
  if (!EventShapes::are_measured(recording)) shape_tally_.take_without_ratios();
  moduli_.reserve(recording.events());
  if (table_.is_rheocyte_table()) standard_errors_.reserve(recording.events());
}

void Extraction::Columns::resize(std::size_t count) {
  area.resize(count);
  deformation.resize(count);
  moduli.resize(count);
}

std::size_t Extraction::block() const {
  const auto stored = [](const std::string& source) { return source != "mask" && source != "contour"; };
  const bool by_outlines =
      event_shapes_.has_asymmetry() || !stored(shapes().area_from()) || !stored(shapes().deformation_from());
  return by_outlines ? block_of_outlines : block_of_scalars;
}

EventBlock Extraction::compute(std::size_t first, std::size_t count) {
  Columns& c = columns_;
  c.resize(count);
  events_.read(first, count);
  events_.stored_shapes().read(first, c.area, c.deformation);
  const auto viscosity = events_.viscosity_mPas();
  const MeasuredEvents events{c.area, c.deformation, viscosity};
  comparison_.estimate(conditions(), events);
  const EstimatedModuli moduli = c.moduli.estimates();
  table().estimate(conditions(), events, moduli);
  add_inertia_error(moduli);
  if (table().is_rheocyte_table()) mark_unresolved(moduli);
  compute_shapes(first, events);
  if (effective_map_) compute_effective(events);
  leave_out_cut();
  if (!events_.gates().empty()) apply_gates();
  collect();
  const auto& s = c.shapes;
  return {c.area,
          c.deformation,
          viscosity,
          c.moduli.kPa,
          c.moduli.standard_error_kPa,
          c.moduli.states,
          s.excess,
          s.mode_3,
          s.elongation.block(),
          s.outlines,
          s.tilt,
          c.effective.kPa,
          c.effective.standard_error_kPa,
          c.effective.states};
}

bool Extraction::take_tension(const EffectiveCell& cell) {
  if (!cell.is_found()) return false;
  ChannelFlow flow = conditions().flow;
  flow.viscosity_mPas = cell.viscosity_mPas;
  auto grid = grid_under_tension(*tables_.proportioned(flow.exponent).in_liquid, {flow, tables_.section()},
                                 cell.axial_tension_Pa.value, conditions().pixel_size_um);
  if (!grid) return false;
  effective_map_ = std::make_unique<const GridMap>(*std::move(grid));
  effective_cell_ = cell;
  return true;
}

void Extraction::compute_effective(const MeasuredEvents& events) {
  columns_.effective.resize(events.size.size());
  const EstimatedModuli moduli = columns_.effective.estimates();
  effective_map_->estimate(conditions(), events, moduli);
  add_inertia_error(moduli);
  mark_unresolved(moduli);
}

void Extraction::compute_shapes(std::size_t first, const MeasuredEvents& events) {
  event_shapes_.compute(first, events, columns_.shapes);
  if (!event_shapes_.elongated_by()) return;
  ElongationValues& e = columns_.shapes.elongation;
  const EstimatedModuli moduli{e.modulus_kPa, e.standard_error_kPa, e.states};
  add_inertia_error(moduli);
  mark_unresolved(moduli);
  for (std::size_t i = 0; i < e.modulus_kPa.size(); ++i)
    if (std::isnan(e.modulus_kPa[i])) e.forget(i, e.states[i]);
}

void Extraction::collect() {
  const auto viscosity = events_.viscosity_mPas();
  for (std::size_t i = 0; i < columns_.moduli.states.size(); ++i) {
    ++summary_.counts[static_cast<std::size_t>(columns_.moduli.states[i])];
    if (has_modulus(columns_.moduli.states[i])) take_modulus(i);
    if (effective_map_) effective_moduli_.take(columns_.effective.states[i], columns_.effective.kPa[i]);
    if (!std::isfinite(viscosity[i])) continue;
    viscosity_sum_ += viscosity[i];
    ++viscosities_;
  }
  const ShapeColumns& s = columns_.shapes;
  shape_tally_.take({s.excess, s.inertia_ratio, columns_.area, columns_.deformation, s.mode_3, s.x_um,
                     columns_.moduli.kPa, s.elongation.block(), s.mode_4_excess, s.mode_5_excess, s.mode_4, s.y_um,
                     s.tilt, columns_.moduli.states, s.elongation.states, s.elongation.cells});
}

void Extraction::add_inertia_error(const EstimatedModuli& moduli) {
  for (std::size_t i = 0; i < moduli.state.size(); ++i)
    rheocyte::add_inertia_error(events_.reynolds(i), moduli.modulus_kPa[i], moduli.standard_error_kPa[i],
                                moduli.state[i]);
}

void Extraction::mark_unresolved(const EstimatedModuli& moduli) {
  for (std::size_t i = 0; i < moduli.state.size(); ++i)
    rheocyte::mark_unresolved(moduli.modulus_kPa[i], moduli.standard_error_kPa[i], moduli.state[i]);
}

void Extraction::apply_gates() {
  for (std::size_t i = 0; i < columns_.moduli.states.size(); ++i)
    if (!events_.is_inside(i)) leave_out(i, ModulusState::gated);
}

void Extraction::leave_out_cut() {
  for (std::size_t i = 0; i < columns_.shapes.is_cut.size(); ++i) {
    if (!columns_.shapes.is_cut[i]) continue;
    leave_out(i, ModulusState::cut);
    events_.count_cut(events_.is_inside(i));
  }
}

void Extraction::leave_out(std::size_t i, ModulusState why) {
  Columns& c = columns_;
  c.moduli.forget(i, why);
  if (effective_map_) c.effective.forget(i, why);
  c.shapes.excess[i] = {no_value, no_value, no_value, no_value};
  if (event_shapes_.elongated_by()) c.shapes.elongation.forget(i, why);
}

void Extraction::take_modulus(std::size_t i) {
  moduli_.push_back(columns_.moduli.kPa[i]);
  if (table().is_rheocyte_table())
    standard_errors_.push_back(static_cast<float>(columns_.moduli.standard_error_kPa[i]));
  comparison_.take(i, columns_.moduli.kPa[i]);
}

}  // namespace rheocyte

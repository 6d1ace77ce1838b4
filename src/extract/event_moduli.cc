#include "extract/event_moduli.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace rheocyte {

namespace {

/// With a tension of the liquid one mode more: there is one unknown more.
std::vector<int> features_of(const ModuliTable& table) {
  constexpr int last_of_elongated = 7;
  return table.between.is_elongated() ? features_of_contour(last_of_elongated) : features_of_contour();
}

bool has_free_tension(const ModuliOptions& options, const ModuliTable& table) {
  return options.fit_tension || table.between.is_elongated();
}

CommonErrors relative_errors(const ModuliEstimate& e) {
  const auto relative = [&](Modulus m) { return e.error(m) / e.value(m); };
  return {relative(Modulus::young), relative(Modulus::cortex), e.stiffness_error_kPa / e.stiffness_kPa,
          e.effective_modulus_error_kPa / e.effective_modulus_kPa};
}

}  // namespace

EventsBeyond events_beyond(const CombinedPopulation& population) {
  using enum TableSide;
  const CellsBeyond& of_law = population.beyond;
  const auto events_of = [&](std::size_t cells) {
    const double share = double(cells) / double(std::max<std::size_t>(of_law.all, 1));
    return std::size_t(std::lround(share * double(population.fit.events)));
  };
  EventsBeyond beyond;
  beyond.add(softer, events_of(of_law.softer));
  beyond.add(longer, events_of(of_law.longer));
  beyond.add(smaller, population.smaller);
  beyond.add(larger, population.larger);
  return beyond;
}

EventModuli::EventModuli(const ExtractSettings& settings, const ModuliOptions& options, const ModuliTable& table,
                         Section seen_in)
    : flow_(settings.conditions.flow),
      section_(seen_in),
      section_error_factor_(table.section_error_factor()),
      pixel_size_um_(settings.pixel_size_um),
      outline_noise_{.deviation = options.outline_noise_um.value_or(0)},
      pixels_(table.between, settings.pixel_size_um * table.simulated.width_um / flow_.width_um,
              outline_noise_.scaled(table.simulated.width_um / flow_.width_um)),
      moduli_(table.between, table.simulated,
              {features_of(table), has_free_tension(options, table), table.between.tension_ratios().front()}),
      tension_(AxialTension::given(options.axial_tension_Pa)) {}

ModuliEstimate EventModuli::fit(const ShapeVector& seen, double viscosity_mPas) const {
  ChannelFlow flow = flow_;
  flow.viscosity_mPas = viscosity_mPas;
  return fit_pixels(moduli_, pixels_, seen, sight(flow), tension_);
}

std::optional<SeenCell> EventModuli::seen_cell(const MeasuredCell& measured, double pictures) const {
  const auto seen =
      seen_shape(moduli_, pixels_, measured.shape, sight(measured.flow), AxialTension::unknown(), pictures);
  if (!seen) return {};
  return SeenCell{seen->shape, measured.flow, measured.cells};
}

void EventModuli::tell_law(std::span<const MeasuredCell> cells, const ValueGate& log_area, const Watch& watch,
                           AxialSummary& summary) const {
  summary.law = {.cells = cells.size(), .axial_tension = tension_};
  if (cells.empty()) return;
  const ChannelFlow flow = median_of(cells).flow;
  SeenPopulation seen{
      .sight = sight(flow), .pixel_size_um = pixel_size_um_, .log_area = log_area, .outline_noise = outline_noise_};
  if (tension_.error_Pa == 0) seen.axial_tension_Pa = tension_.value_Pa;
  const CombinedPopulation found = fit_combined_population(moduli_, seen, cells, watch);
  summary.beyond = events_beyond(found);
  if (found.fit.is_found && summary.beyond.majority(cells.size()).empty())
    summary.law = law_of_cells(found, wall_shear_stress_Pa(flow));
}

CommonErrors EventModuli::common_errors(std::span<const MeasuredCell> cells) const {
  if (cells.size() < MedianCell::min_cells) return {};
  const auto seen = seen_cell(median_of(cells), double(cells.size()));
  if (!seen) return {};
  return relative_errors(moduli_.fit(seen->shape, seen->flow, tension_));
}

MedianCell EventModuli::median_cell(std::span<const MeasuredCell> cells) const {
  if (cells.empty()) return {};
  const auto seen = seen_cell(median_of(cells), 1);
  return seen ? rheocyte::median_cell(moduli_, *seen, tension_) : MedianCell{.cells = cells.size()};
}

}  // namespace rheocyte

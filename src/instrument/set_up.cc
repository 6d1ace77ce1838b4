#include "instrument/set_up.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstdint>

#include "case/user_error.h"
#include "extract/effective_words.h"
#include "extract/event_errors.h"
#include "instrument/measured_set_up.h"

namespace rheocyte {

namespace {

std::uint32_t next_number() {
  static std::atomic<std::uint32_t> last = 0;
  return ++last;
}

rheocyte_cell_tension given_tension(double value_Pa) {
  const bool is_known = !std::isnan(value_Pa);
  return {value_Pa,
          is_known ? 0 : no_value,
          is_known ? 0 : no_value,
          no_value,
          0,
          is_known ? RHEOCYTE_CELL_TENSION_GIVEN : RHEOCYTE_CELL_TENSION_UNKNOWN,
          next_number()};
}

/// Of cells that are computed together.
struct Moduli {
  std::array<double, SetUp::most_together> kPa, error_kPa;
  std::array<ModulusState, SetUp::most_together> state;
};

/// With the errors and states that `rheocyte extract` gives to events.
template <std::size_t most>
void estimate(const GridMap& map, const MeasuredSetUp& measured, const MeasuredEvents& events,
              SmoothEventsOf<most>& smooth, Moduli& moduli) {
  const std::size_t count = events.size.size();
  map.estimate(measured.conditions, events, smooth,
               {{moduli.kPa.data(), count}, {moduli.error_kPa.data(), count}, {moduli.state.data(), count}});
  for (std::size_t i = 0; i < count; ++i) {
    add_inertia_error(measured.reynolds, moduli.kPa[i], moduli.error_kPa[i], moduli.state[i]);
    if (map.is_rheocyte_table()) mark_unresolved(moduli.kPa[i], moduli.error_kPa[i], moduli.state[i]);
  }
}

}  // namespace

SetUp::SetUp(const rheocyte_cell_settings& settings)
    : measured_(std::make_shared<const MeasuredSetUp>(settings)), tension_(given_tension(settings.axial_tension_Pa)) {
  if (std::isinf(settings.axial_tension_Pa)) throw UserError("axial_tension_Pa is infinite.");
  if (tension_.source == RHEOCYTE_CELL_TENSION_UNKNOWN) return;
  take_tension(measured_->conditions.flow);
  if (!under_tension_)
    throw UserError(
        fmt::format("axial_tension_Pa is {:g}: the table of the effective modulus has no cells under such "
                    "a tension.",
                    tension_.value_Pa));
}

SetUp::SetUp(std::shared_ptr<const MeasuredSetUp> measured, const rheocyte_cell_tension& tension)
    : measured_(std::move(measured)), tension_(tension) {
  take_tension(measured_->conditions.flow);
  if (!under_tension_)
    throw NoTension(RHEOCYTE_CELL_NO_TENSION,
                    fmt::format("the cells are under an axial tension of {:.4g} Pa, and the table of the effective "
                                "modulus has no cells under such a tension.",
                                tension_.value_Pa));
}

void SetUp::take_tension(const ChannelFlow& flow) {
  auto grids = grids_under_tension(*measured_->proportioned().in_liquid, {flow, measured_->tables.section()},
                                   tension_.value_Pa, pixel_size_um());
  if (grids) under_tension_ = std::make_unique<const UnderTension>(*std::move(grids));
}

std::unique_ptr<SetUp> SetUp::refreshed(const EventFigures& cells) const {
  if (cells.area_um2.size() < min_events_of_effective_cell)
    throw NoTension(RHEOCYTE_CELL_TOO_FEW_CELLS, fmt::format("{} cells with area, deformation and inertia ratio have "
                                                             "been seen; an axial tension follows from at least {}.",
                                                             cells.area_um2.size(), min_events_of_effective_cell));
  const auto& conditions = measured_->conditions;
  EffectiveCell found = effective_cell(measured_->proportioned(), cells, {conditions.flow, measured_->tables.section()},
                                       conditions.pixel_size_um);
  if (!found.is_found())
    throw NoTension(RHEOCYTE_CELL_NO_TENSION,
                    fmt::format("no axial tension follows from the cells: {}", effective_place_text(found)));
  add_errors_of_model(measured_->reynolds, false, found);
  const Median& tension = found.axial_tension_Pa;
  return std::unique_ptr<SetUp>(
      new SetUp(measured_, {tension.value, tension.error, tension.common_error, found.effective_kPa.value, found.events,
                            RHEOCYTE_CELL_TENSION_OF_CELLS, next_number()}));
}

double SetUp::pixel_size_um() const { return measured_->conditions.pixel_size_um; }

void SetUp::add_moduli(std::span<rheocyte_cell_result> cells) const {
  if (cells.size() <= few_events)
    add_moduli<few_events>(cells);
  else
    add_moduli<event_block_size>(cells);
}

template <std::size_t most>
void SetUp::add_moduli(std::span<rheocyte_cell_result> cells) const {
  std::array<double, most_together> area, deformation;
  for (std::size_t i = 0; i < cells.size(); ++i) area[i] = cells[i].area_um2, deformation[i] = cells[i].deformation;
  const std::size_t count = cells.size();
  const MeasuredEvents events{
      {area.data(), count}, {deformation.data(), count}, {measured_->viscosity_mPas.data(), count}};
  SmoothEventsOf<most> smooth;
  remove_pixels(measured_->conditions, events, smooth);
  Moduli young;
  estimate(*measured_->map, *measured_, events, smooth, young);
  for (std::size_t i = 0; i < count; ++i) {
    rheocyte_cell_result& cell = cells[i];
    cell.young_modulus_kPa = young.kPa[i];
    cell.young_modulus_error_kPa = young.error_kPa[i];
    cell.young_state = int(young.state[i]);
    cell.effective_modulus_kPa = cell.effective_modulus_error_kPa = no_value;
    cell.stiffness_kPa = cell.stiffness_error_kPa = no_value;
    cell.effective_state = RHEOCYTE_CELL_NO_DATA;
    cell.axial_tension_Pa = tension_.value_Pa;
    cell.setup = tension_.setup;
  }
  if (!under_tension_) return;
  Moduli effective, stiffness;
  estimate(under_tension_->effective_modulus, *measured_, events, smooth, effective);
  estimate(under_tension_->stiffness, *measured_, events, smooth, stiffness);
  for (std::size_t i = 0; i < count; ++i) {
    rheocyte_cell_result& cell = cells[i];
    cell.effective_modulus_kPa = effective.kPa[i];
    cell.effective_modulus_error_kPa = effective.error_kPa[i];
    cell.stiffness_kPa = stiffness.kPa[i];
    cell.stiffness_error_kPa = stiffness.error_kPa[i];
    cell.effective_state = int(effective.state[i]);
  }
}

}  // namespace rheocyte

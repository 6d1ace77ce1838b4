#include "instrument/measured_set_up.h"

#include <fmt/format.h>

#include <cmath>
#include <string>

#include "case/to_path.h"
#include "case/user_error.h"
#include "events/measured_ranges.h"
#include "events/plausibility.h"
#include "events/recording_temperature.h"
#include "instrument/set_up.h"
#include "measurement/viscosity.h"

namespace rheocyte {

namespace {

std::string text_of(const char* text) { return text ? text : ""; }

double in_range(double value, const char* setting, const char* unit, const Range& range) {
  if (std::isnan(value)) throw UserError(fmt::format("{} is missing.", setting));
  if (!range.contains(value))
    throw UserError(fmt::format("{} is {:g}, outside {}.", setting, value, range_text(range, unit)));
  return value;
}

Buffer buffer_of(const rheocyte_cell_settings& settings) {
  const std::string medium = text_of(settings.medium), model = text_of(settings.viscosity_model);
  if (medium.empty()) throw UserError("medium is missing, and viscosity_mPas as well: give one of them.");
  const auto known = medium_of_name(medium);
  if (!known)
    throw UserError(fmt::format("medium \"{}\" has no known viscosity{}; give viscosity_mPas.", one_line(medium, 60),
                                near_medium(medium)));
  const auto by = viscosity_model_of_name(model.empty() ? name_of(ViscosityModel::buyukurganci_2022) : model);
  if (!by)
    throw UserError(fmt::format("viscosity_model \"{}\" is unknown; there are buyukurganci-2022 and herold-2017.",
                                one_line(model, 60)));
  if (!is_possible_temperature(settings.temperature_C))
    throw UserError(fmt::format("temperature_C is {:g}; it must lie between {:g} and {:g}.", settings.temperature_C,
                                lowest_temperature_C, highest_temperature_C));
  return {*known, *by};
}

ChannelFlow flow_of(const rheocyte_cell_settings& settings) {
  const MeasuredRanges ranges = measured_ranges();
  ChannelFlow flow{in_range(settings.channel_width_um, "channel_width_um", "um", ranges.channel_width_um),
                   in_range(settings.flow_rate_ul_s, "flow_rate_ul_s", "ul/s", ranges.flow_rate_ul_s)};
  if (!std::isnan(settings.viscosity_mPas)) {
    if (!(settings.viscosity_mPas >= min_viscosity_mPas && std::isfinite(settings.viscosity_mPas)))
      throw UserError(fmt::format("viscosity_mPas is {:g}; liquids in which cells live have at least {:g}.",
                                  settings.viscosity_mPas, min_viscosity_mPas));
    flow.viscosity_mPas = settings.viscosity_mPas;
    return flow;
  }
  const Buffer buffer = buffer_of(settings);
  flow.exponent = buffer.flow_exponent(settings.temperature_C);
  flow.viscosity_mPas = buffer.viscosity(flow, settings.temperature_C);
  return flow;
}

const GridMap& grid_of(const ModulusMap& map) {
  if (const auto* const grid = dynamic_cast<const GridMap*>(&map)) return *grid;
  throw UserError("librheocyte_cell takes no published tables; give a table of rheocyte (grid_*.cbor).");
}

}  // namespace

MeasuringConditions conditions_of(const rheocyte_cell_settings& settings) {
  const ChannelFlow flow = flow_of(settings);
  return {flow, in_range(settings.pixel_size_um, "pixel_size_um", "um", measured_ranges().pixel_size_um)};
}

MeasuredSetUp::MeasuredSetUp(const rheocyte_cell_settings& settings)
    : conditions(conditions_of(settings)),
      tables(text_of(settings.table), {}, to_path(text_of(settings.tables_folder))),
      map(&grid_of(tables.used(conditions.flow.exponent))),
      reynolds(reynolds_at_1_mPas(conditions.flow) / conditions.flow.viscosity_mPas),
      viscosity_mPas(SetUp::most_together, conditions.flow.viscosity_mPas) {}

ProportionedTables MeasuredSetUp::proportioned() const {
  const std::scoped_lock lock(reading_);
  const ProportionedTables found = tables.proportioned(conditions.flow.exponent);
  if (!found.in_liquid)
    throw UserError(
        "the tables of the effective modulus (combined_HL-2D-NH-26.cbor) are missing in the folder of "
        "tables; install the program again, or give tables_folder.");
  return found;
}

}  // namespace rheocyte

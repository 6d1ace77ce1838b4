#include "experiment/plan_settings.h"

#include <utility>

namespace rheocyte {
namespace {

Setting number(std::string_view name, std::string_view label, double& place, Range range, std::string_view sentence,
               std::string_view unit = {}) {
  return {.name = name, .label = label, .place = &place, .sentence = sentence, .unit = unit, .range = range};
}

Setting numbers(std::string_view name, std::string_view label, std::vector<double>& place, Range range,
                std::string_view sentence, std::string_view unit) {
  return {.name = name,
          .label = label,
          .place = &place,
          .sentence = sentence,
          .type_name = "NUMBER,NUMBER",
          .unit = unit,
          .separator = ',',
          .range = range};
}

}  // namespace

Settings settings_of(PlanOptions& o) {
  Setting temperature =
      number("temperature", "Temperature", o.temperature_C, {0, 99}, "temperature of the medium", "degC");
  temperature.former_name = "temperature_C";
  Setting rates = numbers("rate_ul_s", "Flow rates", o.rates_ul_s, {1e-9, 1000}, "flow rates", "ul/s");
  rates.otherwise = "for mean velocities of 0.04, 0.1, 0.2 and 0.4 m/s";
  return {number("radius_um", "Radius", o.radius_um, {0.1, 1000}, "radius of the median cell at rest", "um"),
          number("young_modulus_kPa", "Young's modulus", o.young_modulus_kPa, {1e-4, 1e6},
                 "Young's modulus of the median cell", "kPa"),
          number("spread", "Spread", o.spread, {0.001, 2}, "standard deviation of ln E between cells"),
          number("radius_spread", "Spread of the radius", o.radius_spread, {0, 1},
                 "standard deviation of ln r0 between cells"),
          number("between_recordings", "Between recordings", o.between_recordings, {0, 2},
                 "standard deviation of ln E between recordings of one condition"),
          number("difference", "Difference", o.difference, {-0.99, 100},
                 "relative difference of E between conditions, 0.1 = 10 %"),
          number("power", "Power", o.power, {0.06, 0.999}, "probability of detecting the difference"),
          number("cells", "Cells", o.cells, {2, 1e9}, "number of cells per recording"),
          number("mode_2", "Elongation", o.mode_2, {-0.05, 0.3}, "elongation of the cells: mode c2 of their outlines"),
          number("pixel_size_um", "Pixel size", o.pixel_size_um, {0.01, 10}, "size of a pixel", "um"),
          std::move(temperature),
          numbers("width_um", "Channel widths", o.widths_um, {1, 10000}, "widths of the channels", "um"),
          {.name = "medium",
           .label = "Media",
           .place = &o.media,
           .sentence = "media in which the cells are suspended",
           .type_name = "MEDIUM,MEDIUM",
           .separator = ','},
          std::move(rates)};
}

}  // namespace rheocyte

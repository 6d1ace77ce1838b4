#include "synth/synth_keys.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>

namespace rheocyte {

namespace {

template <double SynthSpec::*field>
SynthNumber number(Range range, std::optional<double> fallback, bool is_whole = false) {
  return {range, fallback, [](SynthSpec& spec, double value) { spec.*field = value; }, is_whole, !fallback};
}

template <std::string SynthSpec::*field>
SynthWord text(std::string_view fallback, std::vector<std::string_view> options = {}) {
  return {std::move(options), fallback, [](SynthSpec& spec, const std::string& value) { spec.*field = value; }};
}

template <auto field>
SynthSpread spread(Range range, std::optional<double> fallback = {}) {
  return {range, fallback, [](SynthSpec& spec, const Spread& value) { spec.*field = value; }};
}

void set_kind(SynthSpec& spec, const std::string& word) {
  spec.kind = word == "solid" ? CellKind::solid : word == "shell" ? CellKind::shell : CellKind::combined;
}

void set_cortex_modulus(SynthSpec& spec, const Spread& value) {
  (spec.kind == CellKind::combined ? spec.cortex_modulus : spec.stiffness) = value;
}

// The ranges are wide; they catch wrong units.
const std::array table{
    SynthKey{"recording.cells", "", "how many cells are drawn from the population",
             number<&SynthSpec::cells>({1, 1e7}, 500, true)},
    SynthKey{"recording.seed", "", "of the random numbers; equal seeds give equal files",
             number<&SynthSpec::seed>({0, 9e15}, 1, true)},
    SynthKey{"recording.pixel_size_um", "um", "size of a pixel", number<&SynthSpec::pixel_size_um>({0.01, 10}, 0.34)},
    SynthKey{"recording.pictures", "", "what is stored besides the features",
             SynthWord{{"none", "masks", "images"},
                       "masks",
                       [](SynthSpec& spec, const std::string& word) {
                         spec.pictures = word == "none"    ? Pictures::none
                                         : word == "masks" ? Pictures::masks
                                                           : Pictures::images;
                       }}},
    SynthKey{"recording.width_px", "pixels", "width of the pictures, along the channel",
             number<&SynthSpec::width_px>({16, 2000}, 250, true)},
    SynthKey{"recording.height_px", "pixels", "height of the pictures; 0: that of the channel and its walls",
             number<&SynthSpec::height_px>({0, 2000}, 0, true)},
    SynthKey{"recording.frame_rate_Hz", "Hz", "pictures per second", number<&SynthSpec::frame_rate_Hz>({1, 1e6}, 3000)},
    SynthKey{"recording.cells_per_s", "1/s", "mean rate at which cells arrive",
             number<&SynthSpec::cells_per_s>({1e-3, 1e5}, 100)},
    SynthKey{"recording.sample", "", "name of the sample", text<&SynthSpec::sample>("virtual cells")},
    SynthKey{"recording.date", "", "YYYY-MM-DD", text<&SynthSpec::date>("2026-01-01")},
    SynthKey{"recording.time", "", "HH:MM:SS", text<&SynthSpec::time>("12:00:00")},

    SynthKey{"channel.width_um", "um", "width of the square channel",
             number<&SynthSpec::channel_width_um>({1, 1000}, {})},
    SynthKey{"flow.rate_ul_per_s", "ul/s", "flow rate, sheath and sample together",
             number<&SynthSpec::flow_rate_ul_s>({1e-6, 1e3}, {})},
    SynthKey{"flow.viscosity_mPas", "mPa s", "viscosity of the liquid, in place of a medium",
             SynthNumber{{1e-3, 1e5}, {}, [](SynthSpec& spec, double value) { spec.viscosity_mPas = value; }}},
    SynthKey{"flow.medium", "", "liquid with a known viscosity, e.g. CellCarrier", text<&SynthSpec::medium>("")},
    SynthKey{
        "flow.viscosity_model", "", "how the viscosity of the medium follows",
        text<&SynthSpec::viscosity_model>("buyukurganci-2022", {"buyukurganci-2022", "herold-2017", "kestin-1978"})},
    SynthKey{"flow.temperature_C", "degC", "temperature of the medium at each cell",
             spread<&SynthSpec::temperature_C>({0, 60}, 23)},

    SynthKey{"cell.kind", "", "solid, shell round a liquid, or combined: a solid in a shell",
             SynthWord{{"solid", "shell", "combined"}, "solid", set_kind}},
    SynthKey{"cell.radius_um", "um", "radius of the spheres at rest", spread<&SynthSpec::radius_um>({0.1, 500})},
    SynthKey{"cell.young_modulus_kPa", "kPa", "Young's modulus of solids and combined cells",
             spread<&SynthSpec::stiffness>({1e-6, 1e6})},
    SynthKey{"cell.cortex_modulus_mN_per_m", "mN/m", "modulus E2D of shells and combined cells",
             SynthSpread{{1e-6, 1e6}, {}, set_cortex_modulus}},
    SynthKey{"cell.tension_ratio", "", "tension of shells and combined cells over E2D",
             spread<&SynthSpec::tension_ratio>({0, 100})},
    SynthKey{"cell.tension_mN_per_m", "mN/m", "tension of combined cells, in place of the ratio",
             spread<&SynthSpec::tension_mN_per_m>({0, 1e6})},

    SynthKey{"shapes.table", "",
             "folder of a table by `rheocyte table`, seen from the spec; without it the closed model",
             SynthWord{{}, "", [](SynthSpec& spec, const std::string& word) { spec.table = word; }}},
    SynthKey{"shapes.greatest_deformation", "",
             "cells that the model would deform more are left out; 0: the range in which "
             "the model holds",
             number<&SynthSpec::greatest_deformation>({0, 0.1}, 0)},
    SynthKey{"shapes.duct", "",
             "whose velocity on the axis drives the cells: that of the equivalent tube, or of the square "
             "channel as in the published analytical tables",
             SynthWord{{"tube", "square"},
                       "tube",
                       [](SynthSpec& spec, const std::string& word) { spec.square_duct = word == "square"; }}},

    SynthKey{"noise.lateral_um", "um", "standard deviation of the distance from the channel's axis in the picture",
             number<&SynthSpec::lateral_um>({0, 100}, 0.2)},
    SynthKey{"noise.contour_um", "um", "standard deviation of the error of the outline along its normal",
             number<&SynthSpec::contour_um>({0, 10}, 0)},
    SynthKey{"noise.contour_correlation_um", "um", "length along the outline over which that error is smooth",
             number<&SynthSpec::contour_correlation_um>({0.01, 100}, 0.7)},
    SynthKey{"noise.thermometer_C", "degC", "standard deviation of the error of the stored temperature",
             number<&SynthSpec::thermometer_C>({0, 20}, 0)},
};

std::string range_text(const Range& range, std::string_view unit) {
  return fmt::format("{:g} .. {:g}{}{}", range.least, range.greatest, unit.empty() ? "" : " ", unit);
}

}  // namespace

std::span<const SynthKey> synth_keys() { return table; }

std::string allowed_values(const SynthKey& key) {
  if (const auto* number = std::get_if<SynthNumber>(&key.value)) return range_text(number->range, key.unit);
  if (const auto* spread = std::get_if<SynthSpread>(&key.value))
    return fmt::format("a number in {}, or {{mean = ..., sd = ..., distribution = \"normal\" or \"lognormal\"}}",
                       range_text(spread->range, key.unit));
  const auto& options = std::get<SynthWord>(key.value).options;
  return options.empty() ? "a short text" : fmt::format("\"{}\"", fmt::join(options, "\" or \""));
}

}  // namespace rheocyte

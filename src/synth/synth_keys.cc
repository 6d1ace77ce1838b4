#include "synth/synth_keys.h"

#include <algorithm>
#include <iterator>

#include "case/case_keys.h"
#include "measurement/outline_noise.h"

namespace rheocyte {

namespace {

template <auto field>
Key<SynthSpec> key(KeyDescription description) {
  return key_of<SynthSpec, field>(std::move(description));
}

// A quantity that a case has as well: the same name, unit, range and option.
template <auto field>
Key<SynthSpec> shared(std::string_view name, std::string_view sentence, std::optional<Condition> only_for = {},
                      std::string_view alternative = {}) {
  KeyDescription description = case_key(name);
  description.sentence = sentence;
  description.only_for = only_for;
  description.alternative = alternative;
  return key<field>(std::move(description));
}

// The same, spread over the population.
template <auto field>
Key<SynthSpec> spread(std::string_view name, std::string_view sentence, const Fallback& fallback,
                      std::string_view former_name, std::optional<Condition> only_for = {},
                      std::string_view alternative = {}) {
  auto description = shared<field>(name, sentence, only_for, alternative);
  description.kind = Scatter{std::get<Number>(description.kind).range};
  description.fallback = fallback;
  description.former_name = former_name;
  return description;
}

using Spec = SynthSpec;
using Keys = std::vector<Key<SynthSpec>>;
constexpr Condition no_shell{"cell.kind", "shell", true}, no_solid{"cell.kind", "solid", true},
    is_combined{"cell.kind", "combined"}, by_medium{"flow.viscosity_mPas", "", true},
    by_model{"shapes.model", "analytical"}, by_table{"shapes.model", "table"};
constexpr std::string_view ratio = "cell.cortex.tension_ratio", tension = "cell.cortex.tension_mN_per_m";

// The ranges are wide; they catch wrong units.
Keys recording_keys() {
  return {
      key<&Spec::cells>(
          {"recording.cells", "", "number of cells drawn from the population", Number{{1, 1e7}, true}, 500.0}),
      key<&Spec::seed>({"recording.seed", "", "seed of the random numbers; equal seeds give equal files",
                        Number{{0, 9e15}, true}, 1.0}),
      key<&Spec::pixel_size_um>({"recording.pixel_size_um",
                                 "um",
                                 "size of a pixel",
                                 Number{{0.01, 10}},
                                 0.34,
                                 {},
                                 {},
                                 "--pixel-size-um",
                                 "--pixel-size"}),
      key<&Spec::pictures>({"recording.pictures", "",
                            "data stored in addition to the features; images: masks and pictures in shades of grey",
                            Choice{{"none", "masks", "images"}}, 1}),
      key<&Spec::width_px>({"recording.width_px", "pixels", "width of the pictures, along the channel",
                            Number{{16, 2000}, true}, 250.0}),
      key<&Spec::height_px>({"recording.height_px", "pixels",
                             "height of the pictures; 0: that of the channel and 3 um of wall on each side",
                             Number{{0, 2000}, true}, 0.0}),
      key<&Spec::frame_rate_Hz>({"recording.frame_rate_Hz", "Hz", "pictures per second", Number{{1, 1e6}}, 3000.0}),
      key<&Spec::cells_per_s>(
          {"recording.cells_per_s", "1/s", "mean rate at which cells arrive", Number{{1e-3, 1e5}}, 100.0}),
      key<&Spec::places_um>({"recording.places_um", "um",
                             "places downstream of the contraction at which each cell is seen, with a dynamic table; "
                             "pos_x is the place, so the pictures must be wide enough",
                             List{{0, 1e6}, true}, absent}),
      key<&Spec::sample>({"recording.sample", "", "name of the sample", Word{}, "virtual cells"}),
      key<&Spec::date>({"recording.date", "", "YYYY-MM-DD", Word{}, "2026-01-01"}),
      key<&Spec::time>({"recording.time", "", "HH:MM:SS", Word{}, "12:00:00"}),
  };
}

Keys flow_keys() {
  return {
      shared<&Spec::channel_width_um>("channel.width_um", "width of the square channel"),
      shared<&Spec::flow_rate_ul_s>("flow.rate_ul_per_s", "flow rate, sheath and sample together"),
      shared<&Spec::viscosity_mPas>("flow.viscosity_mPas", "viscosity of the liquid", {}, "flow.medium"),
      spread<&Spec::axial_tension_Pa>(
          "flow.axial_tension_Pa",
          "tension of the liquid along the flow, which elongates the cells; with a table of elongated cells", absent,
          "", by_table),
      key<&Spec::medium>({"flow.medium",
                          "",
                          "liquid of known viscosity: CellCarrier, CellCarrierB, 0.83% MC-PBS, water, ...",
                          Word{},
                          required,
                          {},
                          "flow.viscosity_mPas"}),
      key<&Spec::viscosity_model>({"flow.viscosity_model", "", "model of the viscosity of the medium",
                                   Choice{{"buyukurganci-2022", "herold-2017", "kestin-1978"}}, 0, by_medium}),
      key<&Spec::temperature_C>({"flow.temperature_C", "degC", "temperature of the medium at each cell",
                                 Scatter{{0, 60}}, Spread{.mean = 23}, by_medium}),
  };
}

Keys cell_keys() {
  return {
      key<&Spec::kind>({"cell.kind", "", "solid, shell round a liquid, or combined: a solid in a shell",
                        Choice{{"solid", "shell", "combined"}}, 0}),
      spread<&Spec::radius_um>("cell.radius_um", "radius of the spheres at rest", required, ""),
      spread<&Spec::young_modulus_kPa>("cell.bulk.young_modulus_kPa", "Young's modulus of solids and combined cells",
                                       required, "cell.young_modulus_kPa", no_shell),
      spread<&Spec::cortex_modulus_mN_per_m>("cell.cortex.modulus_mN_per_m",
                                             "modulus E2D of the cortex of shells and combined cells", required,
                                             "cell.cortex_modulus_mN_per_m", no_solid),
      spread<&Spec::tension_ratio>(ratio, "tension over E2D; one number for all shells", absent, "cell.tension_ratio",
                                   no_solid, tension),
      spread<&Spec::tension_mN_per_m>(tension, "tension of combined cells, in place of the ratio", absent,
                                      "cell.tension_mN_per_m", is_combined, ratio),
      spread<&Spec::viscosity_of_cell_mPas>("cell.viscosity_mPas",
                                            "viscosity of the cells' interior, with recording.places_um", absent, ""),
      spread<&Spec::rest_aspect>("cell.rest_aspect",
                                 "length over width of the stress-free cell, a spheroid, with a table of such cells "
                                 "(table.elongated_by = \"rest-shape\")",
                                 absent, "", by_table),
      key<&Spec::added_ellipse>({"cell.added_ellipse", "",
                                 "mode c_2 added to each outline after the model, e.g. 0.1: an elongation along the "
                                 "flow as in many real cells (docs/real-cells.md); true values do not include it",
                                 Number{{-0.3, 0.5}}, 0.0}),
  };
}

Keys shape_keys() {
  return {
      key<&Spec::analytical>({"shapes.model", "",
                              "source of the shapes: a table, or the analytical model of small deformations (linear "
                              "solids and shells in the tube)",
                              Choice{{"table", "analytical"}}, 0}),
      key<&Spec::table>({"shapes.table", "",
                         "folder of a table by `rheocyte table`, relative to the spec, a dynamic one with "
                         "recording.places_um; or a table of the program, by its name or file. Default: the table that "
                         "`rheocyte extract` uses for solids in this liquid, `rheocyte moduli` for combined cells, or "
                         "`rheocyte time-course` for cells at recording.places_um",
                         Word{}, absent, by_table}),
      key<&Spec::max_deformation>(renamed({"shapes.max_deformation", "",
                                           "maximum deformation by the model, beyond which cells are left out; 0: "
                                           "limit of its validity, 0.02 for solids, 0.001 for shells",
                                           Number{{0, 0.1}}, 0.0, by_model},
                                          "shapes.greatest_deformation")),
      key<&Spec::square_duct>({"shapes.duct", "",
                               "channel whose velocity on the axis drives the cells: the equivalent tube, or the "
                               "square channel as in the published analytical tables",
                               Choice{{"tube", "square"}}, 0, by_model}),
  };
}

Keys noise_keys() {
  return {
      key<&Spec::lateral_um>({"noise.lateral_um", "um",
                              "standard deviation of the distance from the channel's axis, in the picture only",
                              Number{{0, 100}}, 0.2}),
      key<&Spec::contour_um>({"noise.contour_um", "um",
                              "standard deviation of the error of the outline along its normal", Number{{0, 10}}, 0.0}),
      key<&Spec::contour_correlation_um>(
          {"noise.contour_correlation_um", "um",
           "standard deviation of the Gaussian that smooths this error along the outline", Number{{0.01, 100}},
           OutlineNoise{}.correlation}),
      key<&Spec::thermometer_C>({"noise.thermometer_C", "degC",
                                 "standard deviation of the error of the stored temperature", Number{{0, 20}}, 0.0}),
  };
}

Keys all_keys() {
  Keys all;
  for (const auto section : {recording_keys, flow_keys, cell_keys, shape_keys, noise_keys})
    std::ranges::move(section(), std::back_inserter(all));
  return all;
}

}  // namespace

std::span<const Key<SynthSpec>> synth_keys() {
  static const Keys all = all_keys();
  return all;
}

Reference synth_reference() {
  return {.title = "Synth reference",
          .topic = "synth",
          .declaration = "src/synth/synth_keys.cc",
          .opening = "The spec of a virtual recording is a text file in TOML. The shortest one:",
          .example = R"([channel]
width_um = 20
[flow]
rate_ul_per_s = 0.04
viscosity_mPas = 15
[cell]
radius_um = {mean = 6.2, sd = 0.5}
[cell.bulk]
young_modulus_kPa = {mean = 2.5, sd = 0.5, distribution = "lognormal"}
)",
          .rules =
              "What is spread over the population is a number, for all cells alike, or has a mean and a standard\n"
              "deviation sd; both are those of the property itself, also for the lognormal law. `--set key=value`\n"
              "replaces a key of the file. The options of the command: `rheocyte synth --help`.\n",
          .keys = key_list(synth_keys())};
}

}  // namespace rheocyte

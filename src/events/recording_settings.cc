#include "events/recording_settings.h"

#include <utility>

#include "case/case_keys.h"
#include "synth/synth_keys.h"

namespace rheocyte {

namespace {

/// A quantity of a case or a spec: unit, range and sentence are those of its key.
Setting of_key(const KeyDescription& key, Setting setting) {
  if (setting.sentence.empty()) setting.sentence = key.sentence;
  if (setting.former_option.empty()) setting.former_option = key.former_option;
  setting.unit = key.unit;
  setting.range = std::get<Number>(key.kind).range;
  return setting;
}

Setting setting(std::string_view name, std::string_view label, SettingPlace place, std::string_view sentence,
                std::string_view otherwise = {}) {
  return {name, label, place, sentence, otherwise};
}

Setting usual(Setting setting) {
  setting.is_usual = true;
  return setting;
}

Setting formerly(std::string_view name, Setting setting) {
  setting.former_name = name;
  return setting;
}

Setting of_type(std::string_view type_name, std::vector<std::string_view> words, Setting setting) {
  setting.type_name = type_name;
  setting.words = std::move(words);
  return setting;
}

Setting in_unit(std::string_view unit, Setting setting) {
  setting.unit = unit;
  return setting;
}

Setting pixel_size(std::optional<double>& um) {
  return of_key(*find_key(synth_keys(), "recording.pixel_size_um"),
                setting("pixel_size_um", "Pixel size", &um, "", "from the recording"));
}

Setting outline_noise(std::optional<double>& um) {
  return of_key(
      *find_key(synth_keys(), "noise.contour_um"),
      setting("outline_noise_um", "Outline noise", &um,
              "standard deviation of the segmentation error of the outline along its normal, in addition to the error "
              "of the pixels, as measured with beads (docs/populations.md); smooth over about 0.7 um of the outline",
              "0"));
}

Setting patience(std::optional<double>& seconds) {
  Setting patience = in_unit("s", setting("patience", "Patience", &seconds,
                                          "time without any data from a recording after which it is given up", "60"));
  patience.range = {1e-3, 1e9};
  return patience;
}

Setting axial_tension(std::optional<double>& Pa, std::string_view otherwise) {
  return of_key(
      case_key("flow.axial_tension_Pa"),
      setting("axial_tension_Pa", "Axial tension", &Pa,
              "axial tension of the liquid, for the effective modulus of recordings without inertia ratios; equal for "
              "equal medium, channel and flow rate",
              otherwise));
}

/// Of the channel, in two meanings.
Setting section_setting(std::optional<Section>& section, std::string_view sentence, std::string_view otherwise) {
  return of_type("tube|square", {"tube", "square"}, setting("section", "Section", &section, sentence, otherwise));
}

/// In which the cells were seen, by a table of the tube.
Setting seen_section(std::optional<Section>& section) {
  return section_setting(section,
                         "cross-section of the channel: square, corrected by the difference between solids there and "
                         "in the tube of the table; or tube, as for virtual cells of such a table",
                         "square, except for virtual cells of the table");
}

Settings gate_settings(GateOptions& gates) {
  constexpr std::string_view limit = "FEATURE=VALUE";
  return {
      formerly("least", of_type(limit, {},
                                setting("min", "a gate", &gates.min,
                                        "use only events whose feature is at least this value, e.g. area_um=40"))),
      formerly("greatest",
               of_type(limit, {},
                       setting("max", "a gate", &gates.max,
                               "use only events whose feature is at most this value, e.g. area_ratio=1.05"))),
      formerly("polygons", of_type("FEATURE,FEATURE=X,Y:...|FILE.poly", {},
                                   setting("polygon", "a polygon", &gates.polygons,
                                           "use only events within a polygon in the plane of two features, e.g. "
                                           "area_um,deform=40,0.01:90,0.01:90,0.1; log:area_um draws its edges over "
                                           "the logarithm; or a file of polygon filters of DCscope or dclab")))};
}

Settings together(Settings first, Settings second) {
  first.insert(first.end(), std::make_move_iterator(second.begin()), std::make_move_iterator(second.end()));
  return first;
}

/// Of the liquid, in which viscosity and temperature replace each other.
Settings liquid_settings(MeasuringOptions& m) {
  const auto of_medium =
      setting("medium", "Medium", &m.medium,
              "medium in which the cells are suspended, e.g. CellCarrier, 0.59% MC-PBS, water", "from the recording");
  const auto model =
      setting("viscosity_model", "Viscosity model", &m.viscosity_model,
              "model of the viscosity of the medium: buyukurganci-2022 or herold-2017", "buyukurganci-2022");
  const auto temperature = setting("temperature", "Temperature", &m.temperature,
                                   "temperature of the medium: a value in degC; feature, of each event; or metadata",
                                   "of each event if recorded, else from the metadata");
  const auto if_missing =
      setting("temperature_if_missing", "Temperature if missing", &m.temperature_if_missing,
              "temperature in degC for recordings and events without a recorded one", "such recordings are refused");
  return {usual(of_key(case_key("flow.viscosity_mPas"), setting("viscosity_mPas", "Viscosity", &m.viscosity_mPas, "",
                                                                "of the medium, from the viscosity model"))),
          usual(of_type("", {"CellCarrier", "CellCarrierB", "0.83% MC-PBS", "water"}, of_medium)),
          of_type("", {"buyukurganci-2022", "herold-2017"}, model),
          usual(in_unit("degC", of_type("VALUE|feature|metadata", {"feature", "metadata"}, temperature))),
          usual(in_unit("degC", of_type("VALUE", {}, if_missing)))};
}

}  // namespace

Settings settings_of(MeasuringOptions& m) {
  constexpr std::string_view otherwise = "from the recording";
  Settings settings{
      of_key(case_key("channel.width_um"),
             setting("channel_width_um", "Channel width", &m.channel_width_um, "width of the channel", otherwise)),
      of_key(case_key("flow.rate_ul_per_s"), setting("flow_rate_ul_s", "Flow rate", &m.flow_rate_ul_s, "", otherwise)),
      pixel_size(m.pixel_size_um)};
  settings = together(together(std::move(settings), liquid_settings(m)), gate_settings(m.gates));
  settings.push_back(patience(m.patience_s));
  return settings;
}

Settings table_settings(std::string& table, std::optional<Section>& section) {
  return {usual(of_type("TABLE", {},
                        setting("table", "Table", &table,
                                "look-up table: folder of `rheocyte table`, file (grid_*.cbor, or in dclab's format), "
                                "or identifier of a table of the program or of an installed dclab",
                                "the table of the program for the medium"))),
          section_setting(section,
                          "cross-section of the program's tables: square, the channel itself in three dimensions; or "
                          "tube, with the same pressure drop, for larger deformations",
                          "square")};
}

Settings settings_of(ExtractOptions& o) {
  return together(
      together(table_settings(o.table, o.section), settings_of(o.measuring)),
      {formerly("pixelation",
                setting("no_pixelation", "No pixelation", &o.no_pixelation, "do not correct for pixelation")),
       formerly("correct_area", setting("no_area_correction", "No area correction", &o.no_area_correction,
                                        "do not correct areas for pixelation; never done with published tables")),
       formerly("asymmetry", setting("no_asymmetry", "No asymmetry", &o.no_asymmetry,
                                     "do not compute the modulus from the asymmetry of contours and masks; faster")),
       axial_tension(o.axial_tension_Pa, "found from the shapes of the cells")});
}

Settings settings_of(ModuliOptions& o) {
  Setting tension = of_key(case_key("flow.axial_tension_Pa"),
                           setting("axial_tension_Pa", "Axial tension", &o.axial_tension_Pa,
                                   "tension of the liquid along the flow, which elongates the cells; 0 = none",
                                   "fitted to each recording if the table has elongated cells"));
  tension.former_option = "--axial-tension";
  return together(together({seen_section(o.section)}, settings_of(o.measuring)),
                  {setting("fit_tension", "Fit tension", &o.fit_tension,
                           "also fit the tension of the cortex, with a table of several tensions; always done with "
                           "tables of elongated cells"),
                   tension, outline_noise(o.outline_noise_um)});
}

Settings settings_of(TimeCourseOptions& o) { return together({seen_section(o.section)}, settings_of(o.measuring)); }

Settings settings_of(PopulationOptions& o) {
  Setting between = setting("between_recordings", "Between recordings", &o.between_recordings,
                            "standard deviation of ln E between recordings of one condition, known from earlier "
                            "experiments, for a normal test in addition to the t test");
  between.range = {0, 2};
  Setting jobs =
      setting("jobs", "Jobs", &o.jobs, "number of threads; results do not depend on it", "all processor cores");
  jobs.range = {1, 1024};
  return together(
      {of_type("MODEL", {"solid", "cortex", "effective"},
               setting("model", "Cells", &o.model,
                       "model of the cells: solid; effective, cells with a cortex in the proportions of HL60 cells, "
                       "fitted to the medians of area, deformation and inertia ratio; or cortex, with bulk, cortex and "
                       "tensions fitted to the outlines",
                       "solid")),
       seen_section(o.section),
       of_type("MEASURE", {"asymmetry", "odd-deformation", "deformation"},
               setting("by", "By", &o.by,
                       "measure that determines the stiffness, in addition to the area: asymmetry of the outline; "
                       "odd-deformation, from deformation and inertia ratio; or deformation, of cells elongated only "
                       "by the flow",
                       "asymmetry")),
       setting("paired", "Paired", &o.paired,
               "the first recordings of all conditions are from one session, the second ones from another, and so on"),
       std::move(between),
       of_type("NAME=VALUE", {},
               setting("dose", "a dose", &o.doses,
                       "dose of a condition, e.g. drug=0.05; the first condition has dose 0 by default. Reports the "
                       "trend over the doses and the EC50")),
       of_type("UNIT", {},
               setting("dose_unit", "Unit of the dose", &o.dose_unit,
                       "unit of the doses in texts and pictures, e.g. ug/ml", "none")),
       setting("shared_spread", "Shared spread", &o.shared_spread,
               "for solids: one spread of radius and modulus for all recordings of a condition"),
       outline_noise(o.outline_noise_um),
       of_type("TABLE", {},
               setting("table", "Table", &o.table,
                       "table of elongated cells (for --model cortex, of cells with bulk and cortex): file "
                       "elongated_*.cbor (combined_*.cbor), folder of `rheocyte table` with such a file, or identifier "
                       "of a table of the program",
                       "the table of the program")),
       axial_tension(o.axial_tension_Pa, "found from the shapes of the cells of each recording"),
       setting("no_bins", "No bins", &o.no_bins, "do not bin the events of recordings with more than 20,000 events"),
       std::move(jobs)},
      settings_of(o.measuring));
}

Settings settings_of(FeaturesOptions& o) { return {pixel_size(o.pixel_size_um), patience(o.patience_s)}; }

}  // namespace rheocyte

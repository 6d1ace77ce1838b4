#include "app/extract_options.h"

#include <CLI/CLI.hpp>
#include <map>
#include <string>
#include <utility>

#include "app/key_option.h"
#include "case/case_keys.h"
#include "synth/synth_keys.h"

namespace rheocyte {

namespace {

void declare_gate_options(CLI::App& command, GateOptions& options) {
  command.add_option("--min", options.min, "take only events whose feature is not below a value, e.g. area_um=40")
      ->type_name("FEATURE=VALUE")
      ->allow_extra_args(false);
  command.add_option("--max", options.max, "take only events whose feature is not above a value, e.g. area_ratio=1.05")
      ->type_name("FEATURE=VALUE")
      ->allow_extra_args(false);
  command
      .add_option("--polygon", options.polygons,
                  "take only events within a polygon in the plane of two features, e.g. "
                  "area_um,deform=40,0.01:90,0.01:90,0.1; log:area_um draws its edges over the logarithm; or a file "
                  "of polygon filters of DCscope or dclab")
      ->type_name("FEATURE,FEATURE=X,Y:...|FILE.poly")
      ->allow_extra_args(false);
}

}  // namespace

void declare_batch_options(CLI::App& command, BatchOptions& options) {
  command.add_option("FILES", options.inputs, "recordings (.rtdc); folders with -r")->required();
  command.add_option("-o,--output", options.folder, "folder for the results; without it they go beside each recording")
      ->type_name("DIR");
  command.add_flag("-r,--recursive", options.recursive, "search the given folders for recordings");
  command.add_flag("--quiet", options.quiet, "print neither progress nor results");
}

void declare_measuring_options(CLI::App& command, MeasuringOptions& options) {
  const std::string otherwise = "from the recording";
  add_key_option(command, case_key("channel.width_um"), options.channel_width_um, otherwise);
  add_key_option(command, case_key("flow.rate_ul_per_s"), options.flow_rate_ul_s, otherwise);
  add_key_option(command, *find_key(synth_keys(), "recording.pixel_size_um"), options.pixel_size_um, otherwise);
  add_key_option(command, case_key("flow.viscosity_mPas"), options.viscosity_mPas, "that of the medium by its model");
  command.add_option("--medium", options.medium, "e.g. CellCarrier, 0.59% MC-PBS, water; default: from the recording");
  command.add_option("--viscosity-model", options.viscosity_model, "buyukurganci-2022 (default) or herold-2017");
  command
      .add_option("--temperature", options.temperature,
                  "degC; or feature: of each event; or metadata; default: of each event if the recording has it")
      ->type_name("VALUE|feature|metadata");
  command
      .add_option("--temperature-if-missing", options.temperature_if_missing,
                  "degC, only where none is recorded, also of single events")
      ->type_name("VALUE");
  declare_gate_options(command, options.gates);
  command.add_option("--patience", options.patience_s,
                     "give a recording up when nothing was read from it for so many seconds (60)");
}

namespace {

/// "tube" or "square".
CLI::CheckedTransformer section_by_name() {
  static const std::map<std::string, Section> sections{{"tube", Section::tube}, {"square", Section::square}};
  CLI::CheckedTransformer by_name(sections);
  by_name.description("");
  return by_name;
}

}  // namespace

void declare_channel_option(CLI::App& command, std::optional<Section>& section) {
  command
      .add_option("--section", section,
                  "of the channel: square, by the difference between solids there and in the tube of the table "
                  "(default), or tube, as virtual cells of such a table have it (moduli recognises its own)")
      ->type_name("tube|square")
      ->transform(section_by_name());
}

void declare_section_option(CLI::App& command, std::optional<Section>& section) {
  command
      .add_option(
          "--section", section,
          "which of the program's own tables: square, the channel itself in three dimensions (default), or tube, "
          "of equal pressure drop, which reaches greater deformations")
      ->type_name("tube|square")
      ->transform(section_by_name())
      ->excludes("--table");
}

void declare_extract_options(CLI::App& command, ExtractOptions& options, std::function<void()> run) {
  declare_batch_options(command, options.batch);
  command
      .add_option(
          "--table", options.table,
          "look-up table in place of the program's own: a folder of `rheocyte table`, a file (grid_*.cbor, or in "
          "dclab's format), or an identifier of the program's tables or of an installed dclab's")
      ->type_name("TABLE");
  declare_section_option(command, options.section);
  declare_measuring_options(command, options.measuring);
  command.add_flag("--no-pixelation", options.no_pixelation, "correct nothing for the pixels");
  command.add_flag("--no-area-correction", options.no_area_correction,
                   "do not correct areas for the pixels; published tables never do");
  command.add_flag("--no-asymmetry", options.no_asymmetry,
                   "do not read contours and masks for the modulus from the asymmetry of the outlines; faster");
  command.add_flag("--no-tsv", options.no_tsv, "do not write a table with one line per event");
  command.callback([&options, run = std::move(run)] {
    check_measuring_options(options.measuring);
    run();
  });
}

}  // namespace rheocyte

#include "app/plot_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "app/cli.h"
#include "app/extract_options.h"
#include "case/refuse_path.h"
#include "case/to_path.h"
#include "case/user_error.h"
#include "events/recording_list.h"
#include "events/recording_settings.h"
#include "report/shape_features.h"

namespace rheocyte {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t max_number_of_panels = 24, max_number_of_levels = 50;

void check(const PlotOptions& options) {
  check_options(options.measuring);
  check_table(options.table, options.section);
  const auto& recordings = options.inputs;
  if (recordings.size() > max_number_of_panels)
    throw UserError(fmt::format("rheocyte: {} recordings do not fit into one picture; give at most {}.",
                                recordings.size(), max_number_of_panels));
  std::error_code error;
  for (const auto& file : recordings)
    if (fs::is_directory(file, error)) refuse_path(file, "is a folder; give recordings.");
  const bool has_table = !options.table.empty(), has_lines = !options.lines.empty();
  if (options.no_lines && (has_table || has_lines || !options.levels_kPa.empty()))
    throw UserError(
        fmt::format("rheocyte: --no-lines and {} contradict each other; give one of them.", has_table   ? "--table"
                                                                                            : has_lines ? "--lines"
                                                                                                        : "--levels"));
  const bool has_shapes = ShapeFeatures::knows(options.x) || ShapeFeatures::knows(options.y);
  if (!has_usual_axes(options) && ((has_table && !has_shapes) || has_lines || !options.levels_kPa.empty()))
    throw UserError(
        fmt::format("rheocyte: {} and --x or --y contradict each other; isoelasticity lines are drawn over "
                    "area_um and deform only.",
                    has_table   ? "--table"
                    : has_lines ? "--lines"
                                : "--levels"));
  if (options.levels_kPa.empty()) return;
  if (has_lines)
    throw UserError("rheocyte: --levels and --lines contradict each other; levels are for the lines of a table.");
  if (options.levels_kPa.size() > max_number_of_levels)
    throw UserError(fmt::format("rheocyte: --levels: give at most {} moduli.", max_number_of_levels));
  for (const double level : options.levels_kPa)
    if (!(level > 0 && std::isfinite(level)))
      throw UserError(
          "rheocyte: --levels must be positive moduli (kPa), separated by commas; decimals follow a point.");
}

void choose_shapes(PlotOptions& options) {
  if (!has_usual_axes(options))
    throw UserError("rheocyte: --shapes and --x or --y contradict each other; give one of them.");
  options.x = expected_ratio_feature;
  options.y = ratio_feature;
}

}  // namespace

void declare_plot_options(CLI::App& command, PlotOptions& options, std::function<void()> run) {
  command
      .add_option("FILES", options.inputs, "recordings (.rtdc) or tables of events (.csv, .tsv, .txt), one panel each")
      ->required();
  command
      .add_option("-o,--output", options.output,
                  "name of the pictures NAME.png and NAME.svg; default: name of the first recording with _rheocyte, in "
                  "its folder")
      ->type_name("NAME");
  declare_settings(command, table_settings(options.table, options.section));
  command.add_option("--lines", options.lines, "isoelasticity lines in dclab's format, in place of those of the table")
      ->type_name("FILE");
  command.add_option("--x", options.x, "feature on the horizontal axis; default: area_um")->type_name("FEATURE");
  command.add_option("--y", options.y, "feature on the vertical axis; default: deform")->type_name("FEATURE");
  command.add_flag("--shapes", options.shapes,
                   "plot measured against expected inertia ratio: do the cells have the shapes of the model?");
  command.add_flag("--no-lines", options.no_lines, "draw no isoelasticity lines");
  command.add_option("--levels", options.levels_kPa, "moduli (kPa) of the isoelasticity lines, e.g. 0.5,1,2")
      ->delimiter(',');
  declare_settings(command, settings_of(options.measuring));
  command.add_flag("--no-pixelation", options.no_pixelation, "draw the lines without the correction for pixelation");
  command.add_flag("--quiet", options.quiet, "print only errors");
  command.callback([&options, run = std::move(run)] {
    options.inputs = without_companions_of_others(options.inputs);
    if (options.shapes) choose_shapes(options);
    check(options);
    run();
  });
}

fs::path picture_stem(const PlotOptions& options) {
  fs::path stem = options.output;
  if (stem.empty()) {
    const fs::path& first = options.inputs.front();
    return first.parent_path() / to_path(first.stem().string() + "_rheocyte");
  }
  if (stem.extension() == ".png" || stem.extension() == ".svg") stem.replace_extension();
  if (!stem.has_filename() || fs::is_directory(stem))
    refuse_path(options.output, "is a folder; give a name for the pictures with -o.");
  return stem;
}

}  // namespace rheocyte

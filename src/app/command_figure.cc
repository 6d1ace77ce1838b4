// `rheocyte figure N`
// The process becomes the Python program that solves and draws; `exit_code` is set only if that cannot be started.
#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "app/cli.h"
#include "app/commands.h"
#include "app/exit_codes.h"
#include "store/child_process.h"
#include "store/program_file.h"
#include "store/python_package.h"
#include "store/standard_error.h"

namespace rheocyte {

namespace {

struct FigureOptions {
  std::string number;
  std::filesystem::path folder = "figures";
  std::vector<std::string> recordings;
  std::string viscosity_mPas, temperature_if_missing, table;
};

// Returns only if the interpreter cannot be started.
int become_python(const FigureOptions& options) {
  auto call = python_call("figure");
  call.insert(call.end(), {"--program", program_file().string()});
  if (!options.viscosity_mPas.empty()) call.insert(call.end(), {"--viscosity-mPas", options.viscosity_mPas});
  if (!options.temperature_if_missing.empty())
    call.insert(call.end(), {"--temperature-if-missing", options.temperature_if_missing});
  if (!options.table.empty()) call.insert(call.end(), {"--table", options.table});
  call.insert(call.end(), {"--", options.number, options.folder.string()});
  call.insert(call.end(), options.recordings.begin(), options.recordings.end());
  const auto failure = become_program(call);
  tell(fmt::format("rheocyte: cannot start {}; the figures need Python with numpy and matplotlib.", failure));
  return exit_own_bug;
}

}  // namespace

void add_figure_command(CLI::App& app, int& exit_code) {
  auto* command = app.add_subcommand("figure", "reproduce a figure of Mokbel et al. 2017; missing cases are solved");
  command->footer("For example: rheocyte figure 3 -o figures");
  auto options = std::make_shared<FigureOptions>();
  command
      ->add_option("N", options->number,
                   "number of the figure in the paper; entry: a cell entering a narrow channel; square: effect of the "
                   "equivalent tube on cells in a square channel; transit: cells in the planar funnel of a chip, from "
                   "above and from the side; off-axis: cells off the axis in height; real-cells: shapes of recorded "
                   "cells compared with those of the model")
      ->required();
  command->add_option("FILES", options->recordings, "recordings (.rtdc), for real-cells");
  command
      ->add_option("--viscosity-mPas", options->viscosity_mPas,
                   "viscosity of the liquid (mPa s), for recordings without a known medium")
      ->type_name("VALUE");
  command
      ->add_option("--temperature-if-missing", options->temperature_if_missing,
                   "temperature (degC) for recordings without one, as for extract")
      ->type_name("VALUE");
  command
      ->add_option("--table", options->table,
                   "table of cells with bulk and cortex for real-cells, e.g. HC-2D-NH-26: its best-fitting cells are "
                   "drawn with the median outlines")
      ->type_name("TABLE");
  command
      ->add_option("-o,--output", options->folder,
                   "folder for figure-N.png, .svg and .csv; results in its subfolders cases and tables are reused")
      ->type_name("DIR")
      ->capture_default_str();
  command->callback([options, &exit_code] { exit_code = become_python(*options); });
}

}  // namespace rheocyte

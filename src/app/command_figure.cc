// `rheocyte figure N`
// The process becomes the Python program that solves and draws; `exit_code` is set only if that cannot be started.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <string>

#include "app/commands.h"
#include "app/exit_codes.h"
#include "store/child_process.h"
#include "store/python_package.h"
#include "store/standard_error.h"

namespace rheocyte {

namespace {

struct FigureOptions {
  std::string number;
  std::filesystem::path folder = "figures";
};

// Returns only if the interpreter cannot be started.
int become_python(const FigureOptions& options) {
  auto call = python_call("figure");
  call.insert(call.end(),
              {"--program", (program_folder() / "rheocyte").string(), "--", options.number, options.folder.string()});
  const auto failure = become_program(call);
  tell(fmt::format("rheocyte: cannot start {}; the figures need Python with numpy and matplotlib.", failure));
  return exit_own_bug;
}

}  // namespace

void add_figure_command(CLI::App& app, int& exit_code) {
  auto* command = app.add_subcommand("figure", "remake a figure of Mokbel et al. 2017, solving what is missing for it");
  auto options = std::make_shared<FigureOptions>();
  command->add_option("N", options->number, "number of the figure in the paper; entry: a cell enters a narrow channel")
      ->required();
  command
      ->add_option("-o,--output", options->folder,
                   "folder for figure-N.png, .svg and .csv; results in its folders cases and tables are used again")
      ->type_name("DIR")
      ->capture_default_str();
  command->callback([options, &exit_code] { exit_code = become_python(*options); });
}

}  // namespace rheocyte

#include "app/command_figure.h"

#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <string>
#include <system_error>

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

// Returns only if the interpreter cannot be started. The terminal's signals then reach the Python program itself.
int become_python(const FigureOptions& options) {
  auto call = python_call("rheocyte.figure");
  call.insert(call.end(),
              {"--program", (program_folder() / "rheocyte").string(), "--", options.number, options.folder.string()});
  std::vector<char*> arguments;
  for (auto& text : call) arguments.push_back(text.data());
  arguments.push_back(nullptr);
  for (auto& entry : python_environment()) {
    const auto equals = entry.find('=');
    ::setenv(entry.substr(0, equals).c_str(), entry.substr(equals + 1).c_str(), 1);
  }
  ::execvp(arguments[0], arguments.data());
  tell(fmt::format("rheocyte: cannot start {} ({}); the figures need Python with numpy and matplotlib.", call[0],
                   std::generic_category().message(errno)));
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

// `rheocyte view [PATHS...]`
#include <memory>

#include "app/cli.h"
#include "app/commands.h"
#include "view/view.h"

namespace rheocyte {

void add_view_command(CLI::App& app, int&) {
  auto* command = app.add_subcommand("view", "show cells and recordings in the browser");
  command->footer("For example: rheocyte view recordings");
  auto options = std::make_shared<ViewOptions>();
  command
      ->add_option("PATHS", options->paths,
                   "recordings or folders of them, results, cases, tables, or the session.toml of an earlier view; "
                   "default: the example cell")
      ->type_name("PATH");
  command->add_option("--port", options->place.port, "port of the server; 0: any free port")
      ->check(CLI::Range(0, 65535));
  command->add_option("--host", options->place.host, "address of the server; other machines may be able to reach it")
      ->type_name("ADDRESS")
      ->capture_default_str();
  command->add_flag_callback(
      "--no-browser", [options] { options->opens_browser = false; }, "only print the address; do not open a browser");
  command->add_option("-o,--output", options->output, "folder for exports; default: the current folder")
      ->type_name("DIR");
  command->callback([options] { serve_view(*options); });
}

}  // namespace rheocyte

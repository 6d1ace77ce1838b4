// `rheocyte view [PATHS...]`
#include <memory>

#include "app/cli.h"
#include "app/commands.h"
#include "view/view.h"

namespace rheocyte {

void add_view_command(CLI::App& app, int&) {
  auto* command = app.add_subcommand("view", "show cells and recordings in the browser");
  auto options = std::make_shared<ViewOptions>();
  command
      ->add_option("PATHS", options->paths,
                   "recordings or folders of them, results, cases, tables, or the session.toml of an earlier view; "
                   "nothing: the example cell")
      ->type_name("PATH");
  command->add_option("--port", options->place.port, "the port to serve at; 0 or nothing: any that is free")
      ->check(CLI::Range(0, 65535));
  command->add_option("--host", options->place.host, "the address to serve at; others than this machine may reach it")
      ->type_name("ADDRESS")
      ->capture_default_str();
  command->add_flag_callback(
      "--no-browser", [options] { options->opens_browser = false; }, "only print the address, open no browser");
  command->add_option("-o,--output", options->output, "the folder that exports go to; the current one otherwise")
      ->type_name("DIR");
  command->callback([options] { serve_view(*options); });
}

}  // namespace rheocyte

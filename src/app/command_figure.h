// `rheocyte figure N`
#pragma once

namespace CLI {
class App;
}

namespace rheocyte {

/// Adds the command. The process becomes the Python program that solves and draws; `exit_code` is set only if that
/// cannot be started.
void add_figure_command(CLI::App& app, int& exit_code);

}  // namespace rheocyte

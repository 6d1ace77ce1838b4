// `rheocyte plot FILES... [--table TABLE]`
#pragma once

namespace CLI {
class App;
}

namespace rheocyte {

/// Adds the command. Each recording is read in a process of its own; the Python package draws. `exit_code`: 0, 1 if the
/// drawing program fails, 2 if a recording could not be used (no picture then), 128 + signal.
void add_plot_command(CLI::App& app, int& exit_code);

}  // namespace rheocyte

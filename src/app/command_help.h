// `rheocyte help [case|COMMAND]`
#pragma once

namespace CLI {
class App;
}

namespace rheocyte {

/// Adds the command; it prints to standard output.
void add_help_command(CLI::App& app);

}  // namespace rheocyte

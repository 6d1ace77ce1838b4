// What the program does with a command line: parse, run, and turn every failure into one sentence and an exit code.
#pragma once

namespace CLI {
class App;
}

namespace rheocyte {

/// Parses and runs the callbacks of the chosen command, which leave their result in `exit_code`.
/// Returns the exit code of the process (exit_codes.h); errors go to standard error as one line.
int run_command_line(CLI::App& app, int argc, char** argv, const int& exit_code);

}  // namespace rheocyte

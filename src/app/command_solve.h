// `rheocyte solve` on the light side: everything is checked here, in milliseconds; the engine is started only then.
#pragma once

namespace CLI {
class App;
}

namespace rheocyte {

/// Adds the command. If all is well the process becomes rheocyte-engine with the arguments `argv`.
void add_solve_command(CLI::App& app, char** argv, int& exit_code);

}  // namespace rheocyte

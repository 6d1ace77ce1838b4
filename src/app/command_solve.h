// `rheocyte solve`.
#pragma once

namespace CLI {
class App;
}

namespace rheocyte {

void add_solve_command(CLI::App& app, int& exit_code);

}  // namespace rheocyte

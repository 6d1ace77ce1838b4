// `rheocyte moduli`: E, E2D and tension of the cells in recordings.
#pragma once

namespace CLI {
class App;
}

namespace rheocyte {

void add_moduli_command(CLI::App& app, int& exit_code);

}  // namespace rheocyte

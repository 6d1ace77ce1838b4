// `rheocyte synth SPEC.toml -o FILE.rtdc`
#pragma once

namespace CLI {
class App;
}

namespace rheocyte {

/// Adds the command. The file appears whole or not at all. `exit_code`: 0, 2 for the user's errors, 128 + signal.
void add_synth_command(CLI::App& app, int& exit_code);

}  // namespace rheocyte

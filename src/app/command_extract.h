// `rheocyte extract FILES... [-o DIR]`
#pragma once

namespace CLI {
class App;
}

namespace rheocyte {

/// Adds the command. Each recording is read in a process of its own, so that a damaged one harms no other. `exit_code`:
/// 0, 2 if a recording could not be used, 3 if one has no event with a modulus, 128 + signal.
void add_extract_command(CLI::App& app, int& exit_code);

}  // namespace rheocyte

// `rheocyte picture DIR`
#pragma once

namespace CLI {
class App;
}

namespace rheocyte {

/// Adds the command. UserError if the folder holds no result; `exit_code` 1 if the picture cannot be drawn.
void add_picture_command(CLI::App& app, int& exit_code);

}  // namespace rheocyte

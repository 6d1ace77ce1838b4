// `rheocyte table`: a whole look-up table from a spec.
#pragma once

namespace CLI {
class App;
}

namespace rheocyte {

void add_table_command(CLI::App& app, int& exit_code);

}  // namespace rheocyte

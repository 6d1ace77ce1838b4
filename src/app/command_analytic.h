// `rheocyte analytic cell|table|lines`
#pragma once

namespace CLI {
class App;
}

namespace rheocyte {

/// Adds the commands of the closed model for small deformations. They print to standard output and write only the
/// files that are asked for. UserError.
void add_analytic_command(CLI::App& app);

}  // namespace rheocyte

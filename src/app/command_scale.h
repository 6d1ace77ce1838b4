// `rheocyte scale TABLE`
#pragma once

namespace CLI {
class App;
}

namespace rheocyte {

/// Adds the command: a look-up table or isoelasticity lines for another channel, flow rate or viscosity. UserError.
void add_scale_command(CLI::App& app);

}  // namespace rheocyte

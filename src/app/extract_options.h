// The command line of `rheocyte extract`, and the parts of it that other commands on recordings have, too.
#pragma once
#include <functional>
#include <optional>

#include "extract/options.h"

namespace CLI {
class App;
}

namespace rheocyte {

/// Declares FILES, -o, -r and --quiet.
void declare_batch_options(CLI::App& command, BatchOptions& options);

/// Declares those of channel, flow, pixel size, viscosity, temperature, gates and patience: every one of them has a
/// meaning for each command that calls this.
void declare_measuring_options(CLI::App& command, MeasuringOptions& options);

/// Declares all options on the command; `run` is called when they are complete. UserError if they contradict.
void declare_extract_options(CLI::App& command, ExtractOptions& options, std::function<void()> run);

/// --section, of the channel in which the cells were seen, where the table that is given is one of the tube.
void declare_channel_option(CLI::App& command, std::optional<Section>& section);

/// --section, for which the program's own tables are.
void declare_section_option(CLI::App& command, std::optional<Section>& section);

}  // namespace rheocyte

// The command line of `rheocyte extract`, and the parts of it that other commands on recordings have, too.
#pragma once
#include <functional>

#include "events/options.h"
#include "events/setting.h"

namespace CLI {
class App;
}

namespace rheocyte {

/// Declares FILES, -o, -r and --quiet.
void declare_batch_options(CLI::App& command, BatchOptions& options);

/// Declares --jobs, of commands whose recordings have results of their own.
void declare_jobs(CLI::App& command, BatchOptions& options,
                  const std::string& meaning = "number of recordings read in parallel");

/// Declares an option for each setting. UserError during parsing if a value is not a good one.
void declare_settings(CLI::App& command, const Settings& settings);

/// Declares all options on the command; `run` is called when they are complete. UserError if they contradict.
void declare_extract_options(CLI::App& command, ExtractOptions& options, std::function<void()> run);

}  // namespace rheocyte

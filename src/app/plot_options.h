// The command line of `rheocyte plot`.
#pragma once
#include <filesystem>
#include <functional>

#include "report/plot_options.h"

namespace CLI {
class App;
}

namespace rheocyte {

/// Declares the options on the command; `run` is called when they are complete. UserError if they contradict.
void declare_plot_options(CLI::App& command, PlotOptions& options, std::function<void()> run);

/// Name of the pictures without .png or .svg.
std::filesystem::path picture_stem(const PlotOptions& options);

}  // namespace rheocyte

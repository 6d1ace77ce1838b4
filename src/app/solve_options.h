// The command line of `rheocyte solve`; the light program and the engine read it with the same code.
#pragma once
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace rheocyte {

struct SolveOptions {
  std::filesystem::path case_file;
  std::filesystem::path folder;         ///< of the results
  std::filesystem::path continue_from;  ///< folder of an earlier result in time; empty: from the sphere
  std::filesystem::path start_from;     ///< folder of a result in time whose last state is the start; or empty
  std::vector<std::string> settings;    ///< "key=value"
  bool json = false;                    ///< result.json on standard output and nothing else there
  bool quiet = false;                   ///< no progress, no summary
  bool no_picture = false;
  bool check_only = false;  ///< validate the case, solve nothing
};

/// Declares the options on the command; `run` is called when they are complete.
void declare_solve_options(CLI::App& command, SolveOptions& options, std::function<void()> run);

}  // namespace rheocyte

#include "app/command_solve.h"

#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cerrno>
#include <cstdlib>
#include <memory>
#include <system_error>

#include "app/child_process.h"
#include "app/exit_codes.h"
#include "app/result_folder.h"
#include "app/solve_options.h"
#include "app/standard_error.h"
#include "case/read_case.h"

namespace rheocyte {

namespace {

// Returns only if the engine cannot be started.
int become_engine(char** argv) {
  // OpenBLAS reads this when it is loaded. Several threads would slow the small dense kernels, and change bits.
  ::setenv("OPENBLAS_NUM_THREADS", "1", 1);
  const auto engine = program_folder() / "rheocyte-engine";
  ::execv(engine.c_str(), argv);
  tell(fmt::format("rheocyte: cannot start {} ({}); build or install both programs.", engine.string(),
                   std::generic_category().message(errno)));
  return exit_own_bug;
}

}  // namespace

void add_solve_command(CLI::App& app, char** argv, int& exit_code) {
  auto* command = app.add_subcommand("solve", "compute the stationary shape of one cell");
  auto options = std::make_shared<SolveOptions>();
  declare_solve_options(*command, *options, [options, argv, &exit_code] {
    read_case(options->case_file, options->settings);
    if (options->check_only) return;
    check_result_folder(options->folder);
    exit_code = become_engine(argv);
  });
}

}  // namespace rheocyte

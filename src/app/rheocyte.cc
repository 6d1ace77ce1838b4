// The program that the user calls.
#include <malloc.h>

#include <CLI/CLI.hpp>

#include "app/command_line.h"
#include "app/commands.h"
#include "app/exit_codes.h"
#include "store/build_info.h"
#include "store/process_limits.h"
#include "store/standard_error.h"

int main(int argc, char** argv) {
  // Matrices come and go by the hundred in each iteration: giving their memory back each time costs more than they do.
  ::mallopt(M_MMAP_THRESHOLD, 1 << 30);
  ::mallopt(M_TRIM_THRESHOLD, 1 << 30);
  rheocyte::end_without_memory(rheocyte::exit_own_bug);
  if (const std::string lack = rheocyte::lift_stack_limit(argv); !lack.empty()) {
    rheocyte::tell(lack);
    return rheocyte::exit_user_error;
  }
  CLI::App app{"rheocyte: shapes of cells in the channel of real-time deformability cytometry", "rheocyte"};
  app.set_version_flag("--version", std::string("rheocyte ") + rheocyte::version);
  app.require_subcommand(1);
  app.footer("First steps: rheocyte solve examples/paper-cell.toml -o paper-cell; rheocyte help case");

  int exit_code = 0;
  for (auto* add : rheocyte::all_commands) add(app, exit_code);
  return rheocyte::run_command_line(app, argc, argv, exit_code);
}

// The program that solves; started by `rheocyte solve` with the same arguments once these are known to be right.
#include <CLI/CLI.hpp>

#include "app/command_line.h"
#include "app/solve_case.h"
#include "app/solve_options.h"

int main(int argc, char** argv) {
  CLI::App app{"rheocyte-engine: the solver behind `rheocyte solve`", "rheocyte-engine"};
  app.require_subcommand(1);

  int exit_code = 0;
  rheocyte::SolveOptions options;
  rheocyte::declare_solve_options(*app.add_subcommand("solve", "compute the stationary shape of one cell"), options,
                                  [&] { exit_code = rheocyte::solve_case(options); });
  return rheocyte::run_command_line(app, argc, argv, exit_code);
}

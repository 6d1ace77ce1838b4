// The program that solves; started by `rheocyte solve` with the same arguments once these are known to be right, and by
// `rheocyte table` as its workers.
#include <malloc.h>

#include <CLI/CLI.hpp>

#include "app/command_line.h"
#include "app/solve_case.h"
#include "app/solve_options.h"
#include "app/table_worker.h"

int main(int argc, char** argv) {
  // Matrices come and go by the hundred in each iteration: giving their memory back each time costs more than they do.
  ::mallopt(M_MMAP_THRESHOLD, 1 << 30);
  ::mallopt(M_TRIM_THRESHOLD, 1 << 30);
  CLI::App app{"rheocyte-engine: the solver behind `rheocyte solve`", "rheocyte-engine"};
  app.require_subcommand(1);

  int exit_code = 0;
  rheocyte::SolveOptions options;
  rheocyte::declare_solve_options(*app.add_subcommand("solve", "compute the stationary shape of one cell"), options,
                                  [&] { exit_code = rheocyte::solve_case(options); });
  auto* worker = app.add_subcommand("table-worker", "compute what is missing of a table");
  std::string folder;
  bool check_only = false;
  worker->add_option("DIR", folder)->required();
  worker->add_flag("--check", check_only, "only whether this program can take part");
  worker->callback([&] {
    if (check_only) return rheocyte::check_table(folder);
    exit_code = rheocyte::work_on_table(folder);
  });
  return rheocyte::run_command_line(app, argc, argv, exit_code);
}

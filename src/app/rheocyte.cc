// The program that the user calls.
#include <malloc.h>

#include <CLI/CLI.hpp>

#include "app/command_analytic.h"
#include "app/command_extract.h"
#include "app/command_figure.h"
#include "app/command_help.h"
#include "app/command_line.h"
#include "app/command_moduli.h"
#include "app/command_picture.h"
#include "app/command_plot.h"
#include "app/command_scale.h"
#include "app/command_solve.h"
#include "app/command_synth.h"
#include "app/command_table.h"
#include "store/build_info.h"

int main(int argc, char** argv) {
  // Matrices come and go by the hundred in each iteration: giving their memory back each time costs more than they do.
  ::mallopt(M_MMAP_THRESHOLD, 1 << 30);
  ::mallopt(M_TRIM_THRESHOLD, 1 << 30);
  CLI::App app{"rheocyte: shapes of cells in the channel of real-time deformability cytometry", "rheocyte"};
  app.set_version_flag("--version", std::string("rheocyte ") + rheocyte::version);
  app.require_subcommand(1);
  app.footer("First steps: rheocyte solve examples/paper-cell.toml -o paper-cell; rheocyte help case");

  int exit_code = 0;
  rheocyte::add_solve_command(app, exit_code);
  rheocyte::add_picture_command(app, exit_code);
  rheocyte::add_analytic_command(app);
  rheocyte::add_extract_command(app, exit_code);
  rheocyte::add_moduli_command(app, exit_code);
  rheocyte::add_plot_command(app, exit_code);
  rheocyte::add_scale_command(app);
  rheocyte::add_synth_command(app, exit_code);
  rheocyte::add_figure_command(app, exit_code);
  rheocyte::add_table_command(app, exit_code);
  rheocyte::add_help_command(app);
  return rheocyte::run_command_line(app, argc, argv, exit_code);
}

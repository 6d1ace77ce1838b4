// The program that the user calls.

#include "app/cli.h"
#include "app/command_line.h"
#include "app/commands.h"
#include "app/exit_codes.h"
#include "store/build_info.h"
#include "store/process_limits.h"
#include "store/program.h"
#include "store/standard_error.h"

int main(int argc, char** argv) {
  argv = rheocyte::begin_program(argc, argv);
  rheocyte::keep_freed_memory();
  rheocyte::end_without_memory(rheocyte::exit_own_bug);
  if (const std::string lack = rheocyte::secure_stack(argv); !lack.empty()) {
    rheocyte::tell(lack);
    return rheocyte::exit_user_error;
  }
  CLI::App app{"rheocyte: shapes of cells in the channel of real-time deformability cytometry", "rheocyte"};
  app.set_help_flag("-h,--help", "print this help");
  app.set_version_flag("--version", std::string("rheocyte ") + rheocyte::version, "print the version");
  app.require_subcommand(1);
  app.allow_windows_style_options(false);  // "/folder" is a folder

  int exit_code = 0;
  for (auto* add : rheocyte::all_commands) add(app, exit_code);
  app.footer("First steps: rheocyte solve examples/paper-cell.toml -o paper-cell; rheocyte help case");
  return rheocyte::run_command_line(app, argc, argv, exit_code);
}

// `rheocyte solve CASE -o DIR`
#include <memory>

#include "app/cli.h"
#include "app/commands.h"
#include "app/solve_case.h"
#include "case/user_error.h"

namespace rheocyte {

void add_solve_command(CLI::App& app, int& exit_code) {
  auto* command = app.add_subcommand("solve", "compute the shape of one cell, stationary or in time");
  command->footer("For example: rheocyte solve examples/paper-cell.toml -o paper-cell");
  auto options = std::make_shared<SolveOptions>();
  command->add_option("CASE", options->case_file, "the case, a TOML file (see `rheocyte help case`)")->required();
  command->add_option("-o,--output", options->folder, "folder for the result; an older result in it is replaced")
      ->type_name("DIR");
  command->add_option("--set", options->settings, "replace a key of the case; may be repeated")
      ->type_name("key=value")
      ->expected(1)
      ->allow_extra_args(false)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  command
      ->add_option("--gradient", options->gradients,
                   "add derivatives of all measures with respect to this number of the case (\"all\": every number) to "
                   "result.json; may be repeated")
      ->type_name("KEY")
      ->expected(1)
      ->allow_extra_args(false)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  command
      ->add_option("--continue", options->continue_from,
                   "continue from the last checkpoint in this folder, also after an interrupted computation; only for "
                   "cases with a [time] section")
      ->type_name("DIR");
  command
      ->add_option("--start", options->start_from,
                   "start from the last state in this folder, also of another case with the same cell radius and "
                   "channel; only for cases with a [time] section")
      ->type_name("DIR")
      ->excludes("--continue");
  command
      ->add_option("--threads", options->threads,
                   "maximum number of threads; default: all processors. Results do not depend on it; use 1 to solve "
                   "several cases in parallel")
      ->type_name("N")
      ->check(CLI::Range(1, 1024));
  command->add_flag("--json", options->json,
                    "print only result.json to standard output; without -o no files are written");
  command->add_flag("--quiet", options->quiet, "print neither progress nor summary");
  command->add_flag("--no-picture", options->no_picture, "do not draw picture.png and picture.svg");
  command->add_flag("--no-output-fields", options->no_output_fields,
                    "for cases in time: do not write fields.pvd and the folder fields (up to 2 MB per output); "
                    "fields.vtu of the last state is still written. Repeat the flag with --continue");
  command->add_flag(
      "--check", options->check_only,
      "only check the case (exit code 0 or 2) and write nothing; with --json, print the case with all defaults");
  command->callback([options, &exit_code] {
    if (!options->check_only && !options->json && options->folder.empty())
      throw UserError(
          "rheocyte: the folder for the result is missing; give one with -o, for example -o result, or --json to print "
          "it.");
    exit_code = solve_case(*options);
  });
}

}  // namespace rheocyte

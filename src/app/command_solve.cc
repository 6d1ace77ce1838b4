#include "app/command_solve.h"

#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cerrno>
#include <cstdlib>
#include <memory>
#include <nlohmann/json.hpp>
#include <system_error>

#include "app/exit_codes.h"
#include "app/solve_options.h"
#include "case/read_case.h"
#include "case/write_case.h"
#include "store/build_info.h"
#include "store/child_process.h"
#include "store/result_folder.h"
#include "store/standard_error.h"

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

// What a result of this case will say about it, so that a script can tell whether it has that result already.
void print_case(const Case& c) {
  nlohmann::ordered_json json{{"program", "rheocyte"}, {"version", version}};
  json["case"] = to_json(c);
  json["case_hash"] = case_hash(c);
  fmt::print("{}\n", json.dump(2));
}

}  // namespace

void add_solve_command(CLI::App& app, char** argv, int& exit_code) {
  auto* command = app.add_subcommand("solve", "compute the stationary shape of one cell");
  auto options = std::make_shared<SolveOptions>();
  declare_solve_options(*command, *options, [options, argv, &exit_code] {
    const Case c = read_case(options->case_file, options->settings);
    if (options->check_only) {
      if (options->json) print_case(c);
      return;
    }
    check_result_folder(options->folder);
    exit_code = become_engine(argv);
  });
}

}  // namespace rheocyte

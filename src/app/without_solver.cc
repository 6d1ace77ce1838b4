// What stands for the commands that need the solver in a program that was built without it (RHEOCYTE_SOLVER=OFF).
#include <fmt/format.h>

#include "app/cli.h"
#include "app/commands.h"
#include "case/user_error.h"
#include "result/result_reference.h"

namespace rheocyte {

namespace {

// Whatever its arguments are, one sentence answers them.
void add_refusal(CLI::App& app, const char* name, const char* what) {
  auto* command = app.add_subcommand(name, fmt::format("{}: not in this build, which has no solver", what));
  command->prefix_command();
  command->callback([name] {
    throw UserError(
        fmt::format("rheocyte {}: this rheocyte was built without its solver, only for recordings; build it with "
                    "-DRHEOCYTE_SOLVER=ON, or install the whole package.",
                    name));
  });
}

}  // namespace

void add_solve_command(CLI::App& app, int&) { add_refusal(app, "solve", "compute the shape of one cell"); }
void add_table_command(CLI::App& app, int&) { add_refusal(app, "table", "compute a look-up table"); }
void add_view_command(CLI::App& app, int&) { add_refusal(app, "view", "show cells and recordings in the browser"); }

std::string result_reference(bool) {
  throw UserError("rheocyte help result: this rheocyte was built without its solver and makes no such results.");
}

}  // namespace rheocyte

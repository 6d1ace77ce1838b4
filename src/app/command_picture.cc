// `rheocyte picture DIR`
// `exit_code` 1 if the picture cannot be drawn.
#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <vector>

#include "app/cli.h"
#include "app/commands.h"
#include "app/exit_codes.h"
#include "case/user_error.h"
#include "store/python_package.h"
#include "store/standard_error.h"

namespace rheocyte {

namespace {

int redraw(const std::filesystem::path& folder) {
  std::error_code error;
  if (!std::filesystem::exists(folder / "result.json", error))
    throw UserError(
        fmt::format("{}: there is no result.json; give a folder that `rheocyte solve` has written.", folder.string()));
  const ChildResult drawn = Drawing("picture").finish(std::vector{folder.string()});
  if (drawn.exit_code == exit_converged) return exit_converged;
  if (drawn.exit_code == exit_user_error) throw UserError(drawn.last_line);
  tell(fmt::format("rheocyte: the picture could not be drawn ({}).",
                   drawn.last_line.empty() ? "the drawing program failed" : one_line(drawn.last_line, 300)));
  return exit_own_bug;
}

}  // namespace

void add_picture_command(CLI::App& app, int& exit_code) {
  auto* command = app.add_subcommand("picture", "redraw picture.png and picture.svg of a result");
  auto folder = std::make_shared<std::filesystem::path>();
  command->add_option("DIR", *folder, "folder of a result")->required();
  command->callback([folder, &exit_code] { exit_code = redraw(*folder); });
}

}  // namespace rheocyte

#include "app/picture.h"

#include "store/child_process.h"
#include "store/python_package.h"

namespace rheocyte {

namespace {

std::string draw(const std::string& module, const std::filesystem::path& folder) {
  auto call = python_call(module);
  call.push_back(folder.string());
  const auto drawn = run_child(call, python_environment());
  if (drawn.exit_code == 0) return {};
  return drawn.last_line.empty() ? "the drawing program failed" : drawn.last_line;
}

}  // namespace

std::string draw_picture(const std::filesystem::path& folder) {
  const auto failure = draw("rheocyte.picture", folder);
  std::error_code error;
  if (!failure.empty() || !std::filesystem::exists(folder / "history.csv", error)) return failure;
  return draw("rheocyte.time_picture", folder);
}

std::string draw_table_pictures(const std::filesystem::path& folder) { return draw("rheocyte.table_picture", folder); }

}  // namespace rheocyte

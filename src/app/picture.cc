#include "app/picture.h"

#include "app/child_process.h"
#include "app/python_package.h"

namespace rheocyte {

std::string draw_picture(const std::filesystem::path& folder) {
  auto call = python_call("rheocyte.picture");
  call.push_back(folder.string());
  const auto drawn = run_child(call, python_environment());
  if (drawn.exit_code == 0) return {};
  return drawn.last_line.empty() ? "the drawing program failed" : drawn.last_line;
}

}  // namespace rheocyte

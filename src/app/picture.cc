#include "app/picture.h"

#include <cstdlib>

#include "app/build_info.h"
#include "app/child_process.h"

namespace rheocyte {

namespace fs = std::filesystem;

namespace {

fs::path package_folder() {
  if (const char* given = std::getenv("RHEOCYTE_PYTHON")) return given;
  const fs::path installed = program_folder() / "../share/rheocyte/python";
  return fs::exists(installed) ? installed : fs::path(python_folder);
}

}  // namespace

std::string draw_picture(const fs::path& folder) {
  // -B: a result must not leave byte code beside the sources. Agg: no screen is needed.
  const auto drawn = run_child({python_interpreter, "-B", "-m", "rheocyte.picture", folder.string()},
                               {"PYTHONPATH=" + package_folder().string(), "MPLBACKEND=Agg"});
  if (drawn.exit_code == 0) return {};
  return drawn.last_line.empty() ? "the drawing program failed" : drawn.last_line;
}

}  // namespace rheocyte

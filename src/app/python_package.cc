#include "app/python_package.h"

#include <cstdlib>
#include <filesystem>

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

std::vector<std::string> python_call(const std::string& module) {
  // -B: a result must not leave byte code beside the sources.
  return {python_interpreter, "-B", "-m", module};
}

std::vector<std::string> python_environment() {
  // Agg: no screen is needed.
  return {"PYTHONPATH=" + package_folder().string(), "MPLBACKEND=Agg"};
}

}  // namespace rheocyte

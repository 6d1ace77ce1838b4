#include "store/python_package.h"

#include "store/build_info.h"
#include "store/child_process.h"

namespace rheocyte {

std::vector<std::string> python_call(const std::string& module) {
  // -B: a result must not leave byte code beside the sources.
  return {python_interpreter, "-B", "-m", module};
}

std::vector<std::string> python_environment() {
  const auto folder = supplied_folder("RHEOCYTE_PYTHON", "../share/rheocyte/python", python_folder);
  // Agg: no screen is needed.
  return {"PYTHONPATH=" + folder.string(), "MPLBACKEND=Agg"};
}

}  // namespace rheocyte

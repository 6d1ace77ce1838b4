#include "store/python_package.h"

#include "store/build_info.h"
#include "store/supplied_folder.h"

namespace rheocyte {

std::filesystem::path python_package_folder() {
  return supplied_folder("RHEOCYTE_PYTHON", "../share/rheocyte/python", python_folder);
}

std::vector<std::string> python_call(const std::string& module) {
  // -I: neither the current folder nor PYTHONPATH can put other modules in place of Python's own or of ours.
  // -B: a result must not leave byte code beside the sources.
  return {python_interpreter,
          "-I",
          "-B",
          "-c",
          "import sys; sys.path.insert(0, sys.argv.pop(1)); from rheocyte.start import main; main()",
          python_package_folder().string(),
          module};
}

Drawing::Drawing(const std::string& module) : python_(python_call(module)) {}

ChildResult Drawing::finish(const std::vector<std::string>& arguments) {
  std::string input;
  for (const auto& argument : arguments) input += argument + '\0';
  return python_.finish(input);
}

std::string Drawing::finish(const std::filesystem::path& folder) {
  const auto drawn = finish(std::vector{folder.string()});
  if (drawn.exit_code == 0) return {};
  return drawn.last_line.empty() ? "the drawing program failed" : drawn.last_line;
}

}  // namespace rheocyte

// The Python package that draws: where it is and how it is started.
#pragma once
#include <string>
#include <vector>

namespace rheocyte {

/// Interpreter and options that run a module of the package; the module's arguments follow.
std::vector<std::string> python_call(const std::string& module);

/// "NAME=value" that the module needs in its environment. The environment's RHEOCYTE_PYTHON replaces the folder in
/// which the package is looked for.
std::vector<std::string> python_environment();

}  // namespace rheocyte

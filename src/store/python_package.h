// The Python package that draws, and how it is started.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "store/child_process.h"

namespace rheocyte {

/// The folder that holds the package; the environment's RHEOCYTE_PYTHON replaces it.
std::filesystem::path python_package_folder();

/// The command line that runs a module of the package (python/rheocyte/start.py); the module's arguments follow.
/// Nothing of the current folder nor of the user's own Python takes part.
std::vector<std::string> python_call(const std::string& module);

/// A module of the package that draws. Loading takes longer than drawing: it can begin before there is anything to
/// draw.
class Drawing {
 public:
  explicit Drawing(const std::string& module);

  /// Runs the module with these arguments and waits for it. To be called once.
  ChildResult finish(const std::vector<std::string>& arguments);

  /// The same for files in a folder. Returns the reason if it fails, else an empty text.
  std::string finish(const std::filesystem::path& folder);

 private:
  ChildProcess python_;
};

}  // namespace rheocyte

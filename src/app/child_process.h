// Where the program stands, and helpers that it starts.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace rheocyte {

/// The folder of the running program, links resolved.
std::filesystem::path program_folder();

struct ChildResult {
  int exit_code = -1;     ///< -1: could not be started or was killed
  std::string last_line;  ///< of what it printed on both outputs
};

/// Runs a program and waits for it; its outputs never reach ours. `environment` holds additional "NAME=value".
ChildResult run_child(const std::vector<std::string>& arguments, const std::vector<std::string>& environment);

}  // namespace rheocyte

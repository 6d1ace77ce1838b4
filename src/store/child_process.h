// Where the program stands, and helpers that it starts.
#pragma once
#include <sys/types.h>

#include <filesystem>
#include <string>
#include <vector>

namespace rheocyte {

/// The folder of the running program, links resolved.
std::filesystem::path program_folder();

/// Where files that come with the program lie: the folder that an environment variable names, or the installed one
/// (`installed` is seen from the program's folder), or that of the sources.
std::filesystem::path supplied_folder(const char* variable, const std::filesystem::path& installed,
                                      const std::filesystem::path& source);

struct ChildResult {
  int exit_code = -1;     ///< -1: could not be started or was killed
  std::string last_line;  ///< of what it printed on both outputs
};

/// Runs a program and waits for it; its outputs never reach ours. `environment` holds additional "NAME=value".
ChildResult run_child(const std::vector<std::string>& arguments, const std::vector<std::string>& environment);

/// Becomes another program, which the terminal's signals then reach. Returns only if it cannot be started: its name and
/// the reason.
std::string become_program(const std::vector<std::string>& arguments, const std::vector<std::string>& environment);

/// Waits for the end of a child, whatever signals come. The status is that of waitpid().
int wait_for(pid_t child);

}  // namespace rheocyte

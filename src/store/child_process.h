// Helpers that the program starts.
#pragma once
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace rheocyte {

struct ChildResult {
  int exit_code = -1;     ///< -1: could not be started or was killed
  std::string last_line;  ///< of what it printed on both outputs
};

/// A program that runs beside ours. It has no terminal: its input comes from finish(), its outputs never reach ours.
/// Signals that ask us to stop (SIGINT, SIGTERM) are not meant for it; it gets SIGUSR1 when the thread that started
/// it ends, and on Windows ends with our program.
class ChildProcess {
 public:
  explicit ChildProcess(std::vector<std::string> arguments);
  /// Kills it if it still runs.
  ~ChildProcess();
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  /// Gives it all of its standard input and waits for its end, or kills it when the user begins to want a stop. To be
  /// called once.
  ChildResult finish(std::string_view input);

 private:
  struct Running;  ///< the process and our ends of its input and output
  std::unique_ptr<Running> running_;
};

/// Becomes another program, which the terminal's signals then reach. Returns only if it cannot be started: its name and
/// the reason.
std::string become_program(std::vector<std::string> arguments);

/// Waits for the end of a child, whatever signals come. The status is that of waitpid().
int wait_for(int child);

}  // namespace rheocyte

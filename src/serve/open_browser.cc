#include "serve/open_browser.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <utility>

namespace rheocyte {

namespace {

constexpr const char* opener = "xdg-open";

/// Without our terminal and our signals. -1 if it cannot be started.
pid_t start_alone(const char* program, const std::string& argument) {
  posix_spawn_file_actions_t files;
  posix_spawnattr_t attributes;
  ::posix_spawn_file_actions_init(&files);
  ::posix_spawnattr_init(&attributes);
  for (const int descriptor : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    ::posix_spawn_file_actions_addopen(&files, descriptor, "/dev/null", O_RDWR, 0);
  ::posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSID);
  std::string name(program), word(argument);
  std::array<char*, 3> arguments{name.data(), word.data(), nullptr};
  pid_t child = -1;
  if (::posix_spawnp(&child, program, &files, &attributes, arguments.data(), environ) != 0) child = -1;
  ::posix_spawnattr_destroy(&attributes);
  ::posix_spawn_file_actions_destroy(&files);
  return child;
}

}  // namespace

StartedBrowser::StartedBrowser(const std::string& address) : child_(start_alone(opener, address)) {
  has_failed_ = child_ < 0;
}

bool StartedBrowser::has_just_failed() {
  int status = 0;
  // Some browsers stay in the foreground: only the end of the process shows how it went.
  if (child_ > 0 && ::waitpid(child_, &status, WNOHANG) == child_) {
    child_ = -1;
    has_failed_ = !WIFEXITED(status) || WEXITSTATUS(status) != 0;
  }
  return std::exchange(has_failed_, false);
}

}  // namespace rheocyte

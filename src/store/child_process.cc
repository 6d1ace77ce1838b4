#include "store/child_process.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <utility>

#include "store/last_line.h"
#include "store/process_start.h"
#include "store/stop_signal.h"

namespace rheocyte {

namespace {

std::vector<char*> pointers_to(std::vector<std::string>& texts) {
  std::vector<char*> pointers;
  for (auto& text : texts) pointers.push_back(text.data());
  pointers.push_back(nullptr);
  return pointers;
}

// What becomes of the new process between fork and exec: only calls that are safe there.
[[noreturn]] void become(char* const* arguments, int input, int output, pid_t parent) {
  end_with_parent(SIGUSR1);
  if (::getppid() != parent) ::_exit(1);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) std::signal(signal, SIG_IGN);
  // Away from 0, 1 and 2 first: they are ours if we were started without standard input or output.
  input = ::fcntl(input, F_DUPFD_CLOEXEC, 3);
  output = ::fcntl(output, F_DUPFD_CLOEXEC, 3);
  ::dup2(input, STDIN_FILENO);
  ::dup2(output, STDOUT_FILENO);
  ::dup2(output, STDERR_FILENO);
  ::execvp(arguments[0], arguments);
  ::dprintf(STDERR_FILENO, "%s: %s\n", arguments[0], error_text(errno));
  ::_exit(127);
}

void close(int& descriptor) {
  if (descriptor >= 0) ::close(std::exchange(descriptor, -1));
}

// A program that has ended already does not read: that is described by its end, not by a signal here.
void send(int socket, std::string_view text) {
  while (!text.empty()) {
    const ssize_t count = ::send(socket, text.data(), text.size(), without_signal);
    if (count < 0 && errno != EINTR) return;
    if (count > 0) text.remove_prefix(static_cast<std::size_t>(count));
  }
}

// Until there is something to read, or the end. False once the user wants to stop.
bool wait_to_read(int descriptor, bool wanted_before) {
  for (;;) {
    pollfd awaited{descriptor, POLLIN, 0};
    if (::poll(&awaited, 1, 200) > 0) return true;
    if (stop_wanted() && !wanted_before) return false;
  }
}

std::string last_line_from(int descriptor) {
  const bool wanted_before = stop_wanted();  // then this is a part of stopping
  std::string tail;
  char buffer[1024];
  while (wait_to_read(descriptor, wanted_before)) {
    const ssize_t count = ::read(descriptor, buffer, sizeof buffer);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) break;
    keep_tail(tail, {buffer, static_cast<std::size_t>(count)});
  }
  return last_line_of(tail);
}

}  // namespace

int wait_for(int child) {
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  return status;
}

struct ChildProcess::Running {
  int child = -1;
  int input = -1, output = -1;
};

ChildProcess::ChildProcess(std::vector<std::string> arguments) : running_(std::make_unique<Running>()) {
  const auto pointers = pointers_to(arguments);
  int inputs[2], outputs[2];
  if (make_sockets(inputs) != 0) return;
  if (make_pipe(outputs) == 0) {
    const pid_t parent = ::getpid();
    running_->child = ::fork();
    if (running_->child == 0) become(pointers.data(), inputs[0], outputs[1], parent);
    running_->output = outputs[0];
    ::close(outputs[1]);
  }
  running_->input = inputs[1];
  ::close(inputs[0]);
}

ChildProcess::~ChildProcess() {
  close(running_->input);
  close(running_->output);
  if (running_->child <= 0) return;
  ::kill(running_->child, SIGKILL);
  wait_for(running_->child);
}

ChildResult ChildProcess::finish(std::string_view input) {
  if (running_->child <= 0) return {-1, "it cannot be started"};
  send(running_->input, input);
  ::shutdown(running_->input, SHUT_WR);
  ChildResult result;
  const bool wanted_before = stop_wanted();
  result.last_line = last_line_from(running_->output);
  if (stop_wanted() && !wanted_before) ::kill(running_->child, SIGKILL);
  const int status = wait_for(std::exchange(running_->child, -1));
  if (WIFEXITED(status)) result.exit_code = WEXITSTATUS(status);
  return result;
}

std::string become_program(std::vector<std::string> arguments) {
  ::execvp(arguments[0].c_str(), pointers_to(arguments).data());
  return arguments[0] + " (" + std::generic_category().message(errno) + ")";
}

}  // namespace rheocyte

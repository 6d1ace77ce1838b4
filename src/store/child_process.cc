#include "store/child_process.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <string_view>
#include <system_error>

namespace rheocyte {

namespace {

std::vector<char*> pointers_to(const std::vector<std::string>& texts) {
  std::vector<char*> pointers;
  for (const auto& text : texts) pointers.push_back(const_cast<char*>(text.c_str()));  // C interface, never written to
  pointers.push_back(nullptr);
  return pointers;
}

std::vector<std::string> inherited_environment(const std::vector<std::string>& additional) {
  std::vector<std::string> all = additional;
  for (char** entry = environ; *entry; ++entry) {
    const std::string_view text(*entry);
    const auto name = text.substr(0, text.find('=') + 1);
    bool replaced = false;
    for (const auto& other : additional) replaced = replaced || other.starts_with(name);
    if (!replaced) all.emplace_back(text);
  }
  return all;
}

std::string last_line_from(int descriptor) {
  constexpr std::size_t kept = 4096;
  std::string tail;
  char buffer[1024];
  for (;;) {
    const ssize_t count = ::read(descriptor, buffer, sizeof buffer);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) break;
    tail.append(buffer, static_cast<std::size_t>(count));
    if (tail.size() > kept) tail.erase(0, tail.size() - kept);
  }
  const auto end = tail.find_last_not_of("\n ");
  if (end == std::string::npos) return {};
  const auto start = tail.rfind('\n', end);
  return tail.substr(start == std::string::npos ? 0 : start + 1,
                     end - (start == std::string::npos ? 0 : start + 1) + 1);
}

}  // namespace

int wait_for(pid_t child) {
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  return status;
}

std::filesystem::path program_folder() {
  std::error_code error;
  return std::filesystem::read_symlink("/proc/self/exe", error).parent_path();
}

std::filesystem::path supplied_folder(const char* variable, const std::filesystem::path& installed,
                                      const std::filesystem::path& source) {
  if (const char* given = std::getenv(variable)) return given;
  const std::filesystem::path place = program_folder() / installed;
  std::error_code error;
  return std::filesystem::exists(place, error) ? place : source;
}

ChildResult run_child(const std::vector<std::string>& arguments, const std::vector<std::string>& environment) {
  int ends[2];
  if (::pipe2(ends, O_CLOEXEC) != 0) return {};
  posix_spawn_file_actions_t actions;
  ::posix_spawn_file_actions_init(&actions);
  ::posix_spawn_file_actions_adddup2(&actions, ends[1], STDOUT_FILENO);
  ::posix_spawn_file_actions_adddup2(&actions, ends[1], STDERR_FILENO);
  const auto all = inherited_environment(environment);
  pid_t child = 0;
  const int failed = ::posix_spawnp(&child, arguments[0].c_str(), &actions, nullptr, pointers_to(arguments).data(),
                                    pointers_to(all).data());
  ::posix_spawn_file_actions_destroy(&actions);
  ::close(ends[1]);
  ChildResult result;
  if (failed) {
    result.last_line = arguments[0] + ": " + std::generic_category().message(failed);
  } else {
    result.last_line = last_line_from(ends[0]);
    const int status = wait_for(child);
    result.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }
  ::close(ends[0]);
  return result;
}

std::string become_program(const std::vector<std::string>& arguments, const std::vector<std::string>& environment) {
  ::execvpe(arguments[0].c_str(), pointers_to(arguments).data(),
            pointers_to(inherited_environment(environment)).data());
  return arguments[0] + " (" + std::generic_category().message(errno) + ")";
}

}  // namespace rheocyte

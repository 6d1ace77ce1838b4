#include "run_program.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <thread>

namespace rheocyte::test {

namespace fs = std::filesystem;

namespace {

[[noreturn]] void become(const Command& wanted, const fs::path& out, const fs::path& err) {
  ::dup2(::open(out.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600), STDOUT_FILENO);
  ::dup2(::open(err.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600), STDERR_FILENO);
  for (const auto& [name, value] : wanted.environment) ::setenv(name.c_str(), value.c_str(), 1);
  if (!wanted.folder.empty()) fs::current_path(wanted.folder);
  if (wanted.max_file_bytes >= 0) {
    const auto bytes = static_cast<rlim_t>(wanted.max_file_bytes);
    const rlimit limit{bytes, bytes};
    ::setrlimit(RLIMIT_FSIZE, &limit);
  }
  std::signal(SIGHUP, SIG_DFL);  // also where the tests themselves go on without a terminal
  std::vector<char*> arguments;
  for (const auto& argument : wanted.arguments) arguments.push_back(const_cast<char*>(argument.c_str()));
  arguments.push_back(nullptr);
  ::execv(arguments[0], arguments.data());
  ::_exit(127);
}

void send_after_first_words(pid_t child, int signal, const fs::path& err) {
  for (int i = 0; i < 1000; ++i) {  // 10 s at most
    std::error_code error;
    if (const auto size = fs::file_size(err, error); !error && size > 0) break;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  ::kill(child, signal);
}

}  // namespace

Ended run(const Command& wanted) {
  const TemporaryFolder folder;
  const fs::path out = folder.path() / "out", err = folder.path() / "err";
  const auto start = std::chrono::steady_clock::now();
  const pid_t child = ::fork();
  if (child == 0) become(wanted, out, err);
  if (wanted.signal) send_after_first_words(child, wanted.signal, err);
  int status = 0;
  ::waitpid(child, &status, 0);
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
  const int code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  return {code, content_of(out), content_of(err), elapsed.count()};
}

TemporaryFolder::TemporaryFolder() {
  std::string name = (fs::temp_directory_path() / "rheocyte-test-XXXXXX").string();
  if (!::mkdtemp(name.data())) std::abort();
  path_ = name;
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

std::string content_of(const fs::path& file) {
  std::ostringstream text;
  text << std::ifstream(file, std::ios::binary).rdbuf();
  return text.str();
}

void write_file(const fs::path& file, const std::string& content) { std::ofstream(file, std::ios::binary) << content; }

void expect_sentence(const Ended& ended, const std::string& words, int exit_code) {
  EXPECT_EQ(ended.exit_code, exit_code) << words;
  EXPECT_EQ(ended.out, "");
  EXPECT_TRUE(is_one_line(ended.err)) << ended.err;
  EXPECT_NE(ended.err.find(words), std::string::npos) << "wanted: " << words << "\n   got: " << ended.err;
}

bool is_one_line(const std::string& text) { return text.size() > 1 && text.find('\n') == text.size() - 1; }

}  // namespace rheocyte::test

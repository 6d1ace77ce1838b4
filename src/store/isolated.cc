#include "store/isolated.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <memory>
#include <new>
#include <optional>
#include <utility>
#include <vector>

#include "case/user_error.h"
#include "store/child_process.h"
#include "store/isolated_messages.h"
#include "store/process_start.h"
#include "store/stop_signal.h"
#include "store/system_limit.h"

namespace rheocyte {

namespace {

using Clock = std::chrono::steady_clock;
using Kind = IsolatedEnd::Kind;

int pipe_to_parent = -1;

// Ends the child at once: Eigen's matrices do not survive std::bad_alloc, and nothing here can be saved.
[[noreturn]] void tell_of_no_memory() {
  send_want_of_memory(pipe_to_parent);
  ::_exit(0);
}

void limit(const Isolation& limits) {
  const rlimit no_core{0, 0};
  ::setrlimit(RLIMIT_CORE, &no_core);
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)  // their shadow memory needs terabytes of addresses
  // What libraries of others have reserved in this process does not count as memory that the work needs.
  rlim_t taken_pages = 0;
  std::ifstream("/proc/self/statm") >> taken_pages;
  const rlim_t bytes = limits.memory_bytes + taken_pages * static_cast<rlim_t>(::sysconf(_SC_PAGESIZE));
  const rlimit memory{bytes, bytes};
  ::setrlimit(RLIMIT_AS, &memory);
#else
  static_cast<void>(limits);
#endif
}

constexpr std::array stopping_signals{SIGINT, SIGTERM, SIGHUP};

/// Signals that ask the program to stop wait as long as this object lives: until a new process has said what it does
/// about them.
class SignalsHeldBack {
 public:
  SignalsHeldBack() {
    sigset_t stopping;
    ::sigemptyset(&stopping);
    for (const int signal : stopping_signals) ::sigaddset(&stopping, signal);
    ::sigprocmask(SIG_BLOCK, &stopping, &before_);
  }
  ~SignalsHeldBack() { let_through(); }
  SignalsHeldBack(const SignalsHeldBack&) = delete;
  SignalsHeldBack& operator=(const SignalsHeldBack&) = delete;
  void let_through() const { ::sigprocmask(SIG_SETMASK, &before_, nullptr); }

 private:
  sigset_t before_{};
};

[[noreturn]] void be_the_child(const std::function<std::string(const TellProgress&)>& work, const Isolation& limits,
                               int pipe, const SignalsHeldBack& signals) {
  end_with_parent(SIGKILL);
  // A terminal sends its signals to all processes. The parent answers them; a child that died of them would look like
  // one that broke down.
  for (const int signal : stopping_signals) std::signal(signal, SIG_IGN);
  for (const int signal : {SIGSEGV, SIGABRT}) std::signal(signal, SIG_DFL);
  signals.let_through();
  pipe_to_parent = pipe;
  std::set_new_handler(tell_of_no_memory);
  // The C library writes about broken memory to standard error, which would frighten more than it helps.
  const int nowhere = ::open("/dev/null", O_WRONLY | O_CLOEXEC);
  if (nowhere >= 0) {
    ::dup2(nowhere, STDOUT_FILENO);
    ::dup2(nowhere, STDERR_FILENO);
  }
  limit(limits);
  try {
    send(pipe, MessageKind::result, work([pipe](double fraction) { send_progress(pipe, fraction); }));
  } catch (const UserError& error) {
    send(pipe, MessageKind::user_error, error.what());
  } catch (const std::bad_alloc&) {
    send(pipe, MessageKind::no_memory, {});
  } catch (const std::exception& error) {
    send(pipe, MessageKind::own_error, error.what());
  }
  ::_exit(0);  // no destructors of the parent's objects, no flushing of its buffers
}

// What the messages, the status and our own impatience say together.
IsolatedEnd conclude(const IsolatedInbox& inbox, int status) {
  if (WIFEXITED(status) && inbox.has_end()) return inbox.end();
  // A breakdown after the result (when HDF5 closes) does not make the result good: files may be incomplete.
  if (WIFSIGNALED(status))
    return {WTERMSIG(status) == SIGKILL ? Kind::killed : Kind::broke_down, ::strsignal(WTERMSIG(status))};
  return {Kind::broke_down, "it ended without a result"};
}

// What waits for a drive that does not answer cannot be killed before that does; it is not waited for then.
void kill_child(pid_t child) {
  constexpr int rounds = 100, pause_ms = 10;
  ::kill(child, SIGKILL);
  for (int i = 0; i < rounds && ::waitpid(child, nullptr, WNOHANG) == 0; ++i) ::poll(nullptr, 0, pause_ms);
}

}  // namespace

/// A child and what has come from it.
class IsolatedPool::Run {
 public:
  Run(const IsolatedWork& work, Isolation limits, TellProgress on_progress, OnEnd on_end)
      : limits_(std::move(limits)), on_progress_(std::move(on_progress)), on_end_(std::move(on_end)) {
    int ends[2];
    if (make_pipe(ends) != 0) throw SystemLimit("open files", errno);
    std::fflush(nullptr);
    const SignalsHeldBack signals;
    child_ = ::fork();
    if (child_ < 0) {
      const int reason = errno;
      ::close(ends[0]);
      ::close(ends[1]);
      throw SystemLimit("processes", reason);
    }
    if (child_ == 0) {
      ::close(ends[0]);
      be_the_child(work, limits_, ends[1], signals);
    }
    ::close(ends[1]);
    pipe_ = ends[0];
  }
  ~Run() {
    if (!has_ended_) kill_child(child_);
    ::close(pipe_);
  }
  Run(const Run&) = delete;
  Run& operator=(const Run&) = delete;

  int pipe() const { return pipe_; }
  int pause_ms() const { return limits_.is_wanted ? 50 : 200; }

  /// What has come, if there is anything, and whether it has to be given up. Its end, once it has come.
  std::optional<IsolatedEnd> look(bool has_come) {
    if (has_come) {
      last_word_ = Clock::now();
      if (!inbox_.read_from(pipe_)) return has_ended_ = true, conclude(inbox_, wait_for(child_));
    }
    const bool hangs = std::chrono::duration<double>(Clock::now() - last_word_).count() > limits_.patience_s;
    const bool stops = stop_wanted() || (limits_.is_wanted && !limits_.is_wanted());
    if (!hangs && !stops) return std::nullopt;
    kill_child(child_);
    has_ended_ = true;
    return IsolatedEnd{stops ? Kind::stopped : Kind::hung, {}};
  }
  void tell_end(IsolatedEnd end) const { on_end_(std::move(end)); }

 private:
  Isolation limits_;
  TellProgress on_progress_;
  OnEnd on_end_;
  pid_t child_ = -1;
  int pipe_ = -1;
  IsolatedInbox inbox_{on_progress_, limits_.memory_bytes};
  Clock::time_point last_word_ = Clock::now();
  bool has_ended_ = false;
};

IsolatedPool::IsolatedPool(int at_once) : at_once_(at_once) {}
IsolatedPool::~IsolatedPool() = default;

void IsolatedPool::start(const IsolatedWork& work, const Isolation& limits, const TellProgress& on_progress,
                         const OnEnd& on_end) {
  while (std::ssize(runs_) >= at_once_) look();
  runs_.push_back(std::make_unique<Run>(work, limits, on_progress, on_end));
}

void IsolatedPool::wait_for_all() {
  while (!runs_.empty()) look();
}

void IsolatedPool::look() {
  std::vector<pollfd> wanted;
  int pause_ms = 200;
  for (const auto& run : runs_) {
    wanted.push_back({run->pipe(), POLLIN, 0});
    pause_ms = std::min(pause_ms, run->pause_ms());
  }
  const int ready = ::poll(wanted.data(), wanted.size(), pause_ms);
  std::vector<std::pair<std::unique_ptr<Run>, IsolatedEnd>> ended;
  for (std::size_t i = wanted.size(); i-- > 0;) {
    const auto run = runs_.begin() + std::ptrdiff_t(i);
    auto end = (*run)->look(ready > 0 && wanted[i].revents != 0);
    if (!end) continue;
    ended.emplace_back(std::move(*run), std::move(*end));
    runs_.erase(run);
  }
  for (auto& [run, end] : ended) run->tell_end(std::move(end));
}

IsolatedEnd run_isolated_bytes(const IsolatedWork& work, const Isolation& limits, const TellProgress& on_progress) {
  IsolatedEnd result;
  IsolatedPool pool(1);
  pool.start(work, limits, on_progress, [&](IsolatedEnd end) { result = std::move(end); });
  pool.wait_for_all();
  return result;
}

}  // namespace rheocyte

#include "store/isolated.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

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
#include "store/packets.h"
#include "store/process_start.h"
#include "store/stop_signal.h"
#include "store/system_limit.h"

namespace rheocyte {

namespace {

using Clock = std::chrono::steady_clock;
using Kind = IsolatedEnd::Kind;

int socket_to_parent = -1;

// Ends the child at once: Eigen's matrices do not survive std::bad_alloc, and nothing here can be saved.
[[noreturn]] void tell_of_no_memory() {
  send_packet(socket_to_parent, Word::no_memory);
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

[[noreturn]] void be_the_child(const IsolatedWork& work, const Isolation& limits, int socket,
                               const SignalsHeldBack& signals) {
  end_with_parent(SIGKILL);
  // A terminal sends its signals to all processes. The parent answers them; a child that died of them would look like
  // one that broke down.
  for (const int signal : stopping_signals) std::signal(signal, SIG_IGN);
  for (const int signal : {SIGSEGV, SIGABRT}) std::signal(signal, SIG_DFL);
  signals.let_through();
  socket_to_parent = socket;
  std::set_new_handler(tell_of_no_memory);
  // The C library writes about broken memory to standard error, which would frighten more than it helps.
  const int nowhere = ::open("/dev/null", O_WRONLY | O_CLOEXEC);
  if (nowhere >= 0) {
    ::dup2(nowhere, STDOUT_FILENO);
    ::dup2(nowhere, STDERR_FILENO);
  }
  limit(limits);
  try {
    const std::string text = work([socket](double fraction) {
      if (!send_progress(socket, fraction)) ::_exit(1);  // the parent is gone
    });
    if (send_pieces(socket, Word::piece, text)) send_packet(socket, Word::done);
  } catch (const UserError& error) {
    send_packet(socket, Word::user_error, error.what());
  } catch (const std::bad_alloc&) {
    send_packet(socket, Word::no_memory);
  } catch (const std::exception& error) {
    send_packet(socket, Word::own_error, error.what());
  }
  ::_exit(0);  // no destructors of the parent's objects, no flushing of its buffers
}

// What the messages, the status and our own impatience say together.
IsolatedEnd conclude(std::optional<IsolatedEnd> said, int status) {
  if (WIFEXITED(status) && said) return std::move(*said);
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
  Run(const IsolatedWork& work, const Isolation& limits, Watch watch, OnEnd on_end)
      : patience_s_(limits.patience_s), watch_(std::move(watch)), on_end_(std::move(on_end)) {
    const PacketSockets sockets;
    std::fflush(nullptr);
    const SignalsHeldBack signals;
    child_ = ::fork();
    if (child_ == 0) {
      ::close(sockets.ours);
      be_the_child(work, limits, sockets.theirs, signals);
    }
    const int reason = errno;
    ::close(sockets.theirs);
    socket_ = sockets.ours;
    if (child_ > 0) return;
    ::close(socket_);
    throw SystemLimit("processes", reason);
  }
  ~Run() {
    if (!has_ended_) kill_child(child_);
    ::close(socket_);
  }
  Run(const Run&) = delete;
  Run& operator=(const Run&) = delete;

  int socket() const { return socket_; }

  /// Takes what has come, and says whether it has to be given up. Its end, once it has come.
  std::optional<IsolatedEnd> look() {
    constexpr int most_packets = 32;  // others, and the watch, have their turn
    for (int i = 0; i < most_packets; ++i) {
      const Packet packet = receive_packet(socket_, 0);
      if (packet.word == Word::none) break;
      last_word_ = Clock::now();
      if (packet.word == Word::closed) return has_ended_ = true, conclude(std::move(said_), wait_for(child_));
      take(packet);
    }
    const bool hangs = std::chrono::duration<double>(Clock::now() - last_word_).count() > patience_s_;
    const bool stops = stop_wanted() || watch_.stop();
    if (!hangs && !stops) return std::nullopt;
    kill_child(child_);
    has_ended_ = true;
    return IsolatedEnd{stops ? Kind::stopped : Kind::hung, {}};
  }
  void tell_end(IsolatedEnd end) const { on_end_(std::move(end)); }

 private:
  void take(const Packet& packet) {
    switch (packet.word) {
      case Word::progress: return watch_.progress(progress_in(packet));
      case Word::piece: result_ += packet.text; return;
      case Word::done: said_ = {Kind::finished, std::move(result_)}; return;
      case Word::user_error: said_ = {Kind::user_error, packet.text}; return;
      case Word::no_memory: said_ = {Kind::no_memory, {}}; return;
      default: said_ = {Kind::own_error, packet.text};
    }
  }

  double patience_s_;
  Watch watch_;
  OnEnd on_end_;
  pid_t child_ = -1;
  int socket_ = -1;
  std::string result_;
  std::optional<IsolatedEnd> said_;
  Clock::time_point last_word_ = Clock::now();
  bool has_ended_ = false;
};

IsolatedPool::IsolatedPool(int at_once) : at_once_(at_once) {}
IsolatedPool::~IsolatedPool() = default;

void IsolatedPool::start(const IsolatedWork& work, const Isolation& limits, const Watch& watch, const OnEnd& on_end) {
  while (std::ssize(runs_) >= at_once_) look();
  runs_.push_back(std::make_unique<Run>(work, limits, watch, on_end));
}

void IsolatedPool::wait_for_all() {
  while (!runs_.empty()) look();
}

void IsolatedPool::look() {
  constexpr int pause_ms = 50;
  std::vector<pollfd> awaited;
  for (const auto& run : runs_) awaited.push_back({run->socket(), POLLIN, 0});
  ::poll(awaited.data(), awaited.size(), pause_ms);
  std::vector<std::pair<std::unique_ptr<Run>, IsolatedEnd>> ended;
  for (std::size_t i = runs_.size(); i-- > 0;) {
    const auto run = runs_.begin() + std::ptrdiff_t(i);
    auto end = (*run)->look();
    if (!end) continue;
    ended.emplace_back(std::move(*run), std::move(*end));
    runs_.erase(run);
  }
  for (auto& [run, end] : ended) run->tell_end(std::move(end));
}

IsolatedEnd run_isolated_bytes(const IsolatedWork& work, const Isolation& limits, const Watch& watch) {
  IsolatedEnd result;
  IsolatedPool pool(1);
  pool.start(work, limits, watch, [&](IsolatedEnd end) { result = std::move(end); });
  pool.wait_for_all();
  return result;
}

}  // namespace rheocyte

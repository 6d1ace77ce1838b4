#include "store/work_host.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <new>
#include <optional>
#include <system_error>
#include <utility>

#include "case/user_error.h"
#include "store/child_process.h"
#include "store/private_folder.h"
#include "store/system_limit.h"

namespace rheocyte {

namespace {

namespace fs = std::filesystem;

// Each message is one packet, so that two processes may answer in turn and one that breaks leaves no half message. The
// first byte says what it is.
enum class Word : char {
  request = 'q',
  request_end = 'r',
  piece = 'd',
  progress = 'p',
  done = 'f',
  sentence = 'e',
  limit = 'l'
};

constexpr std::size_t longest_piece = std::size_t{1} << 16U;  // packets of this size always fit
constexpr int patience_ms = 100'000;  // longer than that of isolated work, which tells of its end itself

bool send_message(int socket, Word word, std::string_view text) {
  std::string packet(1, static_cast<char>(word));
  packet += text.substr(0, longest_piece);
  for (;;) {
    if (::send(socket, packet.data(), packet.size(), MSG_NOSIGNAL) >= 0) return true;
    if (errno != EINTR) return false;
  }
}

bool send_pieces(int socket, Word word, std::string_view text) {
  for (std::size_t at = 0; at < text.size(); at += longest_piece)
    if (!send_message(socket, word, text.substr(at, longest_piece))) return false;
  return true;
}

struct HostMessage {
  Word word = Word::done;
  std::string text;
};

/// Nothing once the other end is closed, or silent for too long.
std::optional<HostMessage> receive_message(int socket) {
  std::string packet(longest_piece + 1, '\0');
  for (;;) {
    pollfd awaited{socket, POLLIN, 0};
    const int ready = ::poll(&awaited, 1, patience_ms);
    if (ready < 0 && errno == EINTR) continue;
    if (ready <= 0) return std::nullopt;
    const ssize_t count = ::recv(socket, packet.data(), packet.size(), 0);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return std::nullopt;
    return HostMessage{static_cast<Word>(packet.front()), packet.substr(1, static_cast<std::size_t>(count) - 1)};
  }
}

void send_request(int socket, const std::string& request) {
  if (send_pieces(socket, Word::request, request)) send_message(socket, Word::request_end, {});
}

std::optional<std::string> receive_request(int socket) {
  std::string request;
  while (const auto message = receive_message(socket)) {
    if (message->word == Word::request_end) return request;
    request += message->text;
  }
  return std::nullopt;
}

/// One byte, because nothing cannot be sent, with room for one descriptor.
struct DescriptorMessage {
  DescriptorMessage() {
    header.msg_iov = &content;
    header.msg_iovlen = 1;
    header.msg_control = space;
    header.msg_controllen = sizeof space;
  }
  DescriptorMessage(const DescriptorMessage&) = delete;
  DescriptorMessage& operator=(const DescriptorMessage&) = delete;

  alignas(cmsghdr) char space[CMSG_SPACE(sizeof(int))] = {};
  char byte = 0;
  iovec content{&byte, 1};
  msghdr header{};
};

bool pass_descriptor(int socket, int descriptor) {
  DescriptorMessage message;
  cmsghdr* const head = CMSG_FIRSTHDR(&message.header);
  head->cmsg_level = SOL_SOCKET;
  head->cmsg_type = SCM_RIGHTS;
  head->cmsg_len = CMSG_LEN(sizeof descriptor);
  std::memcpy(CMSG_DATA(head), &descriptor, sizeof descriptor);
  return ::sendmsg(socket, &message.header, MSG_NOSIGNAL) == 1;
}

/// -1 once the other end is closed.
int take_descriptor(int socket) {
  for (;;) {
    DescriptorMessage message;
    const ssize_t count = ::recvmsg(socket, &message.header, MSG_CMSG_CLOEXEC);
    if (count < 0 && errno == EINTR) continue;
    const cmsghdr* const head = count == 1 ? CMSG_FIRSTHDR(&message.header) : nullptr;
    if (!head || head->cmsg_type != SCM_RIGHTS) return -1;
    int descriptor = -1;
    std::memcpy(&descriptor, CMSG_DATA(head), sizeof descriptor);
    return descriptor;
  }
}

[[noreturn]] void be_a_worker(int socket, const WorkHost::Work& work) {
  std::signal(SIGCHLD, SIG_DFL);
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  const auto request = receive_request(socket);
  if (!request) ::_exit(1);
  try {
    work(*request, WorkReply(socket));
    send_message(socket, Word::done, {});
  } catch (const SystemLimit& limit) {
    send_message(socket, Word::limit, limit.what());
  } catch (const UserError& error) {
    send_message(socket, Word::sentence, error.what());
  } catch (const std::bad_alloc&) {
    send_message(socket, Word::limit, memory_does_not_suffice);
  } catch (const std::exception& error) {
    send_message(socket, Word::sentence,
                 fmt::format("An error of the program itself, please report it: {}", one_line(error.what(), 300)));
  }
  ::_exit(0);  // no destructors of the program's objects, no flushing of its buffers
}

[[noreturn]] void be_the_host(int control, const WorkHost::Work& work, const std::function<void()>& prepare,
                              const fs::path& folder) {
  // A terminal sends its signals to all processes; the program answers them, and the end of its socket ends the host.
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGCHLD}) std::signal(signal, SIG_IGN);
  const int nowhere = ::open("/dev/null", O_RDWR | O_CLOEXEC);
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) ::dup2(nowhere, stream);
  try {
    if (prepare) prepare();
  } catch (const std::exception&) {  // each piece of work will meet the reason again and tell it
  }
  for (;;) {
    const int socket = take_descriptor(control);
    if (socket < 0) break;
    const pid_t child = ::fork();
    if (child == 0) {
      ::close(control);
      be_a_worker(socket, work);
    }
    if (child < 0) send_message(socket, Word::limit, SystemLimit("processes", errno).what());
    ::close(socket);
  }
  while (::waitpid(-1, nullptr, 0) > 0) {  // until all have noticed that nobody waits for them
  }
  std::error_code error;
  fs::remove_all(folder, error);
  ::_exit(0);
}

}  // namespace

void WorkReply::give(std::string_view piece) const {
  if (!send_pieces(socket_, Word::piece, piece)) ::_exit(1);
}

void WorkReply::report_progress(double fraction) const {
  if (!send_message(socket_, Word::progress, {reinterpret_cast<const char*>(&fraction), sizeof fraction})) ::_exit(1);
}

bool WorkReply::is_wanted() const {
  pollfd asker{socket_, POLLRDHUP, 0};
  return ::poll(&asker, 1, 0) <= 0;
}

void WorkReply::end_answer() const {
  if (!send_message(socket_, Word::done, {})) ::_exit(1);
}

std::optional<std::string> WorkReply::next_request() const {
  pollfd awaited{socket_, POLLIN, 0};
  while (::poll(&awaited, 1, -1) < 0 && errno == EINTR) {
  }
  return receive_request(socket_);
}

HostedWork::HostedWork(HostedWork&& other) noexcept
    : socket_(std::exchange(other.socket_, -1)), is_wanted_(std::move(other.is_wanted_)) {}

HostedWork::~HostedWork() {
  if (socket_ >= 0) ::close(socket_);
}

void HostedWork::stop() const { ::shutdown(socket_, SHUT_RDWR); }

// A process that has ended is told of when its answer is read.
void HostedWork::ask(const std::string& request) const { send_request(socket_, request); }

void HostedWork::read(const Take& take, const TellProgress& on_progress) {
  for (;;) {
    if (waits_in_vain()) throw UserError("Nobody waits any more for what was asked.");
    const auto message = receive_message(socket_);
    if (!message) break;
    switch (message->word) {
      case Word::piece:
        if (!take(message->text)) return;
        break;
      case Word::progress:
        if (double fraction = 0; on_progress && message->text.size() == sizeof fraction) {
          std::memcpy(&fraction, message->text.data(), sizeof fraction);
          on_progress(fraction);
        }
        break;
      case Word::done: return;
      case Word::limit: throw SystemLimit(message->text);
      default: throw UserError(message->text);
    }
  }
  throw UserError("The process that reads recordings ended before it had answered; try again.");
}

/// Returns false as soon as there is something to read.
bool HostedWork::waits_in_vain() const {
  constexpr int look_ms = 50;
  pollfd awaited{socket_, POLLIN, 0};
  while (is_wanted_) {
    if (!is_wanted_()) return true;
    if (::poll(&awaited, 1, look_ms) > 0) return false;
  }
  return false;
}

WorkHost::WorkHost(const Work& work, const std::function<void()>& prepare) : folder_(new_private_folder()) {
  int ends[2];
  if (::socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends) != 0) throw SystemLimit("open files", errno);
  std::fflush(nullptr);
  host_ = ::fork();
  if (host_ < 0) throw SystemLimit("processes", errno);
  if (host_ == 0) {
    ::close(ends[0]);
    be_the_host(ends[1], work, prepare, folder_.path.parent_path());
  }
  ::close(ends[1]);
  control_ = ends[0];
}

WorkHost::~WorkHost() {
  ::close(control_);
  wait_for(host_);
}

HostedWork WorkHost::ask(const std::string& request) const {
  int ends[2];
  if (::socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends) != 0) throw SystemLimit("open files", errno);
  HostedWork work(ends[0]);
  bool passed = false;
  {
    const std::scoped_lock alone(mutex_);
    passed = pass_descriptor(control_, ends[1]);
  }
  ::close(ends[1]);
  if (!passed) throw UserError("The process that reads recordings has ended; start the view again.");
  work.ask(request);
  return work;
}

}  // namespace rheocyte

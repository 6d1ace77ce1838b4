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
#include "store/packets.h"
#include "store/private_folder.h"
#include "store/system_limit.h"

namespace rheocyte {

namespace {

namespace fs = std::filesystem;

void send_request(int socket, const std::string& request) {
  if (send_pieces(socket, Word::request, request)) send_packet(socket, Word::request_end);
}

/// Nothing once the other end is closed.
std::optional<std::string> receive_request(int socket) {
  std::string request;
  for (;;) {
    const Packet packet = receive_packet(socket, -1);
    if (packet.word == Word::request_end) return request;
    if (packet.word != Word::request) return std::nullopt;
    request += packet.text;
  }
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
    send_packet(socket, Word::done);
  } catch (const SystemLimit& limit) {
    send_packet(socket, Word::limit, limit.what());
  } catch (const UserError& error) {
    send_packet(socket, Word::user_error, error.what());
  } catch (const std::bad_alloc&) {
    send_packet(socket, Word::limit, memory_does_not_suffice);
  } catch (const std::exception& error) {
    send_packet(socket, Word::user_error,
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
  } catch (const std::exception&) {  // each piece of work will meet the reason again and report it
  }
  for (;;) {
    const int socket = take_descriptor(control);
    if (socket < 0) break;
    const pid_t child = ::fork();
    if (child == 0) {
      ::close(control);
      be_a_worker(socket, work);
    }
    if (child < 0) send_packet(socket, Word::limit, SystemLimit("processes", errno).what());
    ::close(socket);
  }
  while (::waitpid(-1, nullptr, 0) > 0) {  // until all have noticed that no one waits for them
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
  if (!send_progress(socket_, fraction)) ::_exit(1);
}

bool WorkReply::is_wanted() const {
  pollfd asker{socket_, POLLRDHUP, 0};
  return ::poll(&asker, 1, 0) <= 0;
}

void WorkReply::end_answer() const {
  if (!send_packet(socket_, Word::done)) ::_exit(1);
}

std::optional<std::string> WorkReply::next_request() const { return receive_request(socket_); }

HostedWork::HostedWork(HostedWork&& other) noexcept : socket_(std::exchange(other.socket_, -1)) {}

HostedWork::~HostedWork() {
  if (socket_ >= 0) ::close(socket_);
}

// A process that has ended is reported when its answer is read.
void HostedWork::ask(const std::string& request) const { send_request(socket_, request); }

void HostedWork::read(const Take& take, const Watch& watch) {
  constexpr int look_ms = 50;
  for (;;) {
    if (watch.stop()) throw UserError("The request was cancelled.");
    const Packet packet = receive_packet(socket_, look_ms);
    switch (packet.word) {
      case Word::none: break;
      case Word::piece:
        if (!take(packet.text)) return;
        break;
      case Word::progress: watch.progress(progress_in(packet)); break;
      case Word::done: return;
      case Word::limit: throw SystemLimit(packet.text);
      case Word::closed: throw UserError("The process that reads recordings ended before it had answered; try again.");
      default: throw UserError(packet.text);
    }
  }
}

WorkHost::WorkHost(const Work& work, const std::function<void()>& prepare) : folder_(new_private_folder()) {
  const PacketSockets ends;
  std::fflush(nullptr);
  host_ = ::fork();
  if (host_ < 0) throw SystemLimit("processes", errno);
  if (host_ == 0) {
    ::close(ends.ours);
    be_the_host(ends.theirs, work, prepare, folder_.path.parent_path());
  }
  ::close(ends.theirs);
  control_ = ends.ours;
}

WorkHost::~WorkHost() {
  ::close(control_);
  wait_for(host_);
}

HostedWork WorkHost::ask(const std::string& request) const {
  const PacketSockets ends;
  HostedWork work(ends.ours);
  bool passed = false;
  {
    const std::scoped_lock alone(mutex_);
    passed = pass_descriptor(control_, ends.theirs);
  }
  ::close(ends.theirs);
  if (!passed) throw UserError("The process that reads recordings has ended; start the view again.");
  work.ask(request);
  return work;
}

}  // namespace rheocyte

#include "view/connection.h"

#include <arpa/inet.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

namespace rheocyte {

namespace {

using namespace std::chrono_literals;

constexpr auto head_time = 10s, body_time = 30s, write_time = 20s, drain_time = 2s;
constexpr std::size_t max_head = 64 << 10, max_drain = 64 << 20;

void name_of_end(const sockaddr_storage& address, std::string& ip, int& port) {
  char text[INET6_ADDRSTRLEN] = "";
  if (address.ss_family == AF_INET) {
    const auto& v4 = reinterpret_cast<const sockaddr_in&>(address);
    ::inet_ntop(AF_INET, &v4.sin_addr, text, sizeof text);
    port = ntohs(v4.sin_port);
  } else if (address.ss_family == AF_INET6) {
    const auto& v6 = reinterpret_cast<const sockaddr_in6&>(address);
    ::inet_ntop(AF_INET6, &v6.sin6_addr, text, sizeof text);
    port = ntohs(v6.sin6_port);
  }
  ip = text;
}

}  // namespace

Connection::Connection(int socket) : socket_(socket) {
  const int on = 1;
  ::setsockopt(socket_, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);  // head and body are two small packets
}

Connection::~Connection() { ::close(socket_); }

bool Connection::wait(short events, Clock::duration time) const {
  pollfd awaited{socket_, events, 0};
  const auto milliseconds = std::chrono::ceil<std::chrono::milliseconds>(time).count();
  return ::poll(&awaited, 1, static_cast<int>(std::max<long>(0, milliseconds))) > 0;
}

bool Connection::wait_for_request(const std::function<bool()>& goes_on) {
  constexpr auto look = 200ms;
  for (const auto end = Clock::now() + idle_time; available() == 0 && Clock::now() < end;) {
    if (wait(POLLIN, look)) return fill();
    if (!goes_on()) return false;
  }
  return available() > 0;
}

void Connection::begin_head() {
  allowed_ = max_head;
  deadline_ = Clock::now() + head_time;
}

void Connection::begin_body(std::size_t bytes) {
  allowed_ = bytes;
  deadline_ = Clock::now() + body_time;
}

bool Connection::has_left() const {
  pollfd asked{socket_, POLLRDHUP, 0};
  return ::poll(&asked, 1, 0) > 0 && (asked.revents & (POLLRDHUP | POLLHUP | POLLERR | POLLNVAL)) != 0;
}

bool Connection::fill() {
  begin_ = end_ = 0;
  const ssize_t count = ::recv(socket_, buffer_.data(), buffer_.size(), MSG_DONTWAIT);
  if (count > 0) end_ = static_cast<std::size_t>(count);
  return count > 0;
}

ssize_t Connection::read(char* to, size_t size) {
  if (allowed_ == 0) return -1;
  if (available() == 0 && !(wait(POLLIN, deadline_ - Clock::now()) && fill())) return -1;
  const std::size_t count = std::min({size, available(), allowed_});
  std::memcpy(to, buffer_.data() + begin_, count);
  begin_ += count;
  allowed_ -= count;
  return static_cast<ssize_t>(count);
}

ssize_t Connection::write(const char* from, size_t size) {
  for (;;) {
    const ssize_t count = ::send(socket_, from, size, MSG_NOSIGNAL | MSG_DONTWAIT);
    if (count >= 0) return count;
    const bool is_full = errno == EAGAIN || errno == EWOULDBLOCK;
    if (errno != EINTR && !(is_full && wait(POLLOUT, write_time))) return -1;
  }
}

void Connection::finish() {
  ::shutdown(socket_, SHUT_WR);
  if (!is_last_) return;
  const auto end = Clock::now() + drain_time;
  for (std::size_t taken = 0; taken < max_drain && Clock::now() < end; taken += available())
    if (!wait(POLLIN, end - Clock::now()) || !fill()) return;
}

void Connection::get_remote_ip_and_port(std::string& ip, int& port) const {
  sockaddr_storage address{};
  socklen_t size = sizeof address;
  if (::getpeername(socket_, reinterpret_cast<sockaddr*>(&address), &size) == 0) name_of_end(address, ip, port);
}

void Connection::get_local_ip_and_port(std::string& ip, int& port) const {
  sockaddr_storage address{};
  socklen_t size = sizeof address;
  if (::getsockname(socket_, reinterpret_cast<sockaddr*>(&address), &size) == 0) name_of_end(address, ip, port);
}

}  // namespace rheocyte

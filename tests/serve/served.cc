#include "served.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <unistd.h>

#include <cstdlib>
#include <utility>

namespace rheocyte::test {

Served::Served(const Router& router)
    : assets_("no-such-folder"), server_(router, assets_, {}, token_), thread_([this] { server_.run(); }) {}

Served::~Served() {
  server_.stop();
  thread_.join();
}

Wire::Wire(int port) : socket_(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
  const timeval patience{.tv_sec = 120, .tv_usec = 0};  // a server that does not answer fails the test
  for (const int way : {SO_RCVTIMEO, SO_SNDTIMEO}) ::setsockopt(socket_, SOL_SOCKET, way, &patience, sizeof patience);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(static_cast<std::uint16_t>(port));
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  if (::connect(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0) close();
}

Wire::~Wire() { close(); }

void Wire::close() {
  if (socket_ >= 0) ::close(std::exchange(socket_, -1));
}

bool Wire::send(std::string_view bytes) const {
  while (!bytes.empty()) {
    const ssize_t count = ::send(socket_, bytes.data(), bytes.size(), MSG_NOSIGNAL);
    if (count <= 0) return false;
    bytes.remove_prefix(std::size_t(count));
  }
  return true;
}

std::string Wire::read_to_end() const {
  std::string text;
  char buffer[4096];
  for (ssize_t count = 0; (count = ::recv(socket_, buffer, sizeof buffer, 0)) > 0;)
    text.append(buffer, std::size_t(count));
  return text;
}

std::string Wire::read_answer() {
  constexpr std::string_view length = "Content-Length: ";
  char buffer[4096];
  for (;;) {
    const std::size_t head = kept_.find("\r\n\r\n"), field = kept_.find(length);
    if (head != std::string::npos && field < head) {
      const std::size_t size = head + 4 + std::strtoul(kept_.c_str() + field + length.size(), nullptr, 10);
      if (kept_.size() >= size) {
        std::string answer = kept_.substr(0, size);
        kept_.erase(0, size);
        return answer;
      }
    }
    const ssize_t count = ::recv(socket_, buffer, sizeof buffer, 0);
    if (count <= 0) return {};
    kept_.append(buffer, std::size_t(count));
  }
}

std::string request_text(const Served& served, std::string_view method, std::string_view path, std::string_view body,
                         std::string_view more_headers) {
  std::string text;
  text.append(method).append(" ").append(path).append(" HTTP/1.1\r\nHost: 127.0.0.1:");
  text.append(std::to_string(served.port())).append("\r\nAuthorization: Bearer ").append(served.token());
  text.append("\r\n").append(more_headers);
  if (!body.empty()) text.append("Content-Length: ").append(std::to_string(body.size())).append("\r\n");
  return text.append("\r\n").append(body);
}

std::string ask(const Served& served, std::string_view method, std::string_view path, std::string_view body) {
  const Wire wire(served.port());
  wire.send(request_text(served, method, path, body));
  return wire.read_to_end();
}

int status_of(std::string_view answer) {
  return answer.starts_with("HTTP/1.1 ") ? std::atoi(std::string(answer.substr(9, 3)).c_str()) : 0;
}

std::string body_of(std::string_view answer) {
  const std::size_t head = answer.find("\r\n\r\n");
  return head == std::string_view::npos ? "" : std::string(answer.substr(head + 4));
}

}  // namespace rheocyte::test

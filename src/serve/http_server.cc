#include "serve/http_server.h"

#include <fmt/format.h>

#include <algorithm>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>
#include <optional>

#include "case/user_error.h"
#include "serve/access.h"
#include "serve/connection.h"
#include "serve/site.h"
#include "serve/system_sockets.h"
#include "store/process_limits.h"

namespace rheocyte {

namespace {

constexpr auto pause_without_room = std::chrono::milliseconds(100);

/// Half of what this process may have open: reading recordings needs some, too.
std::size_t most_connections() {
  constexpr std::size_t some = 4, enough = 500;
  return std::clamp(open_files_limit() / 2, some, enough);
}

[[noreturn]] void refuse_place(const ServedPlace& place, const boost::system::error_code& error) {
  const std::string host = one_line(place.host, 80);
  if (error == boost::asio::error::access_denied)
    throw UserError(
        fmt::format("rheocyte view: port {} is reserved for the administrator of this machine; give one above 1023 "
                    "with --port, or none for any that is free.",
                    place.port));
  if (error == boost::asio::error::address_in_use)
    throw UserError(
        fmt::format("rheocyte view: port {} of {} cannot be taken, another program may use it; give another "
                    "one with --port, or none for any that is free.",
                    place.port, host));
  throw UserError(
      fmt::format("rheocyte view: --host {} is not an address of this machine ({}).", host, error.message()));
}

}  // namespace

class HttpServer::Inside {
 public:
  using Tcp = boost::asio::ip::tcp;

  Inside(const Router& router, const Assets& assets, const ServedPlace& place, const std::string& token)
      : access_(token, place.host, take_port(place)), site_(router, assets, access_) {}

  void run() {
    accept();
    for (;;) try {
        io_.run();
        return;
      } catch (const std::exception&) {  // of one connection, which ends with it
      }
  }

  void stop() {
    boost::asio::post(io_, [this] {
      boost::system::error_code ignored;
      acceptor_.close(ignored);
      pause_.cancel();
      while (!shared_.open.empty()) shared_.open.front()->close();
    });
  }

  const Access& access() const { return access_; }
  int port() const { return port_; }

 private:
  int take_port(const ServedPlace& place) {
    if (place.host.empty())
      throw UserError("rheocyte view: --host is empty; give an address of this machine, for example 127.0.0.1.");
    boost::system::error_code error;
    const auto found = Tcp::resolver(io_).resolve(place.host, std::to_string(place.port), error);
    if (error || found.empty()) refuse_place(place, error);
    const Tcp::endpoint end = *found.begin();
    acceptor_.open(end.protocol(), error);
    if (!error) acceptor_.set_option(Tcp::acceptor::reuse_address(true), error);  // not the port: two would share it
    if (!error) acceptor_.bind(end, error);
    if (!error) acceptor_.listen(Tcp::acceptor::max_listen_connections, error);
    if (error) refuse_place(place, error);
    keep_to_this_process(static_cast<SystemSocket>(acceptor_.native_handle()));
    return port_ = acceptor_.local_endpoint().port();
  }

  void accept() {
    acceptor_.async_accept([this](const boost::system::error_code& error, Tcp::socket socket) {
      if (!acceptor_.is_open()) return;
      if (!error) {
        admit(std::move(socket));
        return accept();
      }
      make_room();  // probably too many open files
      pause_.expires_after(pause_without_room);
      pause_.async_wait([this](const boost::system::error_code&) {
        if (acceptor_.is_open()) accept();
      });
    });
  }

  void admit(Tcp::socket socket) {
    keep_to_this_process(static_cast<SystemSocket>(socket.native_handle()));
    if (shared_.open.size() >= most_connections_ && !make_room()) return;
    std::make_shared<Connection>(std::move(socket), shared_)->begin();
  }

  /// A refused connection gives its place, or else the one that has been silent for longest.
  bool make_room() {
    const auto found = std::ranges::find_if(shared_.open, &Connection::is_dispensable);
    if (found == shared_.open.end()) return false;
    (*found)->close();
    return true;
  }

  boost::asio::io_context io_{1};
  Tcp::acceptor acceptor_{io_};
  boost::asio::steady_timer pause_{io_};
  int port_ = -1;
  std::size_t most_connections_ = most_connections();
  Access access_;
  Site site_;
  SharedByConnections shared_{site_};
};

HttpServer::HttpServer(const Router& router, const Assets& assets, const ServedPlace& place, const std::string& token)
    : inside_(std::make_unique<Inside>(router, assets, place, token)) {}

HttpServer::~HttpServer() = default;

std::string HttpServer::address() const { return inside_->access().address(); }
std::string HttpServer::address_of_once() const { return inside_->access().address_of_once(); }
int HttpServer::port() const { return inside_->port(); }
void HttpServer::run() { inside_->run(); }
void HttpServer::stop() { inside_->stop(); }

}  // namespace rheocyte

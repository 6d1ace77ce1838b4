// A server in this process, and clients as bytes.
#pragma once
#include <string>
#include <string_view>
#include <thread>

#include "serve/http_server.h"

namespace rheocyte::test {

/// Serves while it lives.
class Served {
 public:
  explicit Served(const Router& router);
  ~Served();
  int port() const { return server_.port(); }
  const std::string& token() const { return token_; }
  /// What a browser that the server starts asks for.
  std::string first_target() const { return server_.address_of_once().substr(server_.address_of_once().find("/?")); }

 private:
  std::string token_ = "0123456789abcdef0123456789abcdef";
  Assets assets_;
  HttpServer server_;
  std::thread thread_;
};

/// A connection of a client.
class Wire {
 public:
  explicit Wire(int port);
  ~Wire();
  Wire(const Wire&) = delete;
  Wire& operator=(const Wire&) = delete;

  /// False once the other end has closed.
  bool send(std::string_view bytes) const;
  /// All until the end of the connection.
  std::string read_to_end() const;
  /// One answer with a Content-Length.
  std::string read_answer();
  void close();

 private:
  int socket_ = -1;
  std::string kept_;
};

/// Head and body of a request with the token; the connection is closed afterwards unless it is kept.
std::string request_text(const Served&, std::string_view method, std::string_view path, std::string_view body = {},
                         std::string_view more_headers = "Connection: close\r\n");
/// The whole answer to one request.
std::string ask(const Served&, std::string_view method, std::string_view path, std::string_view body = {});

int status_of(std::string_view answer);
std::string body_of(std::string_view answer);

}  // namespace rheocyte::test

// The server of the view: from connections to answers of the router.
#pragma once
#include <memory>
#include <string>

#include "view/assets.h"
#include "view/router.h"

namespace rheocyte {

struct ServedPlace {
  std::string host = "127.0.0.1";
  int port = 0;  ///< 0: any that is free
};

/// Router and page must outlive it.
class HttpServer {
 public:
  /// Takes the port. UserError if it is in use, or the address is none of this machine.
  HttpServer(const Router&, const Assets&, const ServedPlace&, const std::string& token);
  ~HttpServer();
  HttpServer(const HttpServer&) = delete;
  HttpServer& operator=(const HttpServer&) = delete;

  /// What a browser opens, with the token.
  std::string address() const;
  int port() const;
  /// Answers until stop() is called by another thread.
  void run();
  /// Ends run() after a moment: connections are closed, and whoever computes for one finds that its client has left.
  void stop();

 private:
  class Library;
  std::unique_ptr<Library> library_;
};

}  // namespace rheocyte

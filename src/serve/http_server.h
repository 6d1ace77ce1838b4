// The server of the view: from connections to answers of the router.
#pragma once
#include <memory>
#include <string>

#include "serve/assets.h"
#include "serve/router.h"

namespace rheocyte {

struct ServedPlace {
  std::string host = "127.0.0.1";
  int port = 0;  ///< 0: any that is free
};

/// Router and page must outlive it.
class HttpServer {
 public:
  /// Takes the port. UserError if it is in use or not allowed, or the address is none of this
  /// machine; SystemLimit.
  HttpServer(const Router&, const Assets&, const ServedPlace&, const std::string& token);
  ~HttpServer();
  HttpServer(const HttpServer&) = delete;
  HttpServer& operator=(const HttpServer&) = delete;

  /// What a user opens in a browser, with the token, and what the browser is started with (Access::sign_in_once).
  std::string address() const;
  std::string address_of_once() const;
  int port() const;
  /// Answers until stop() is called by another thread.
  void run();
  /// Ends run() after a moment: connections are closed, and the thread that computes for one finds that its client has
  /// left.
  void stop();

 private:
  class Inside;
  std::unique_ptr<Inside> inside_;
};

}  // namespace rheocyte

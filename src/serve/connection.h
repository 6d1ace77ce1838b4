// One connection: requests are read and answers written by the one thread of the server, answers are made by others.
// Everything has a deadline and a size, so that a slow or broken client holds nothing for long.
#pragma once
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/http/empty_body.hpp>
#include <boost/beast/http/parser.hpp>
#include <boost/beast/http/string_body.hpp>
#include <boost/system/error_code.hpp>
#include <chrono>
#include <functional>
#include <list>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>

#include "serve/answer_threads.h"
#include "serve/site.h"
#include "serve/system_sockets.h"

namespace rheocyte {

class Connection;

/// What the connections of a server share; but for `site` and `threads` the server's thread alone touches it.
struct SharedByConnections {
  const Site& site;
  AnswerThreads threads = {};
  std::list<Connection*> open = {};  ///< those that were refused first, then those that have waited longest
  std::size_t body_bytes = 0;        ///< of all requests that are being read or answered
};

/// Lives as long as something is awaited for it.
class Connection final : public Client, public std::enable_shared_from_this<Connection> {
 public:
  Connection(boost::asio::ip::tcp::socket, SharedByConnections&);

  /// To be called once: waits for the first request.
  void begin();
  /// At once, whatever it does.
  void close();
  /// Whether its place can be given to another client: no request has come whole, or the last one was refused before
  /// its body was read.
  bool is_dispensable() const { return is_waiting_ || is_refused_; }

  /// For all threads.
  bool has_left() const override;

 private:
  using Duration = std::chrono::steady_clock::duration;
  using Parser = boost::beast::http::request_parser<boost::beast::http::empty_body>;
  using BodyParser = boost::beast::http::request_parser<boost::beast::http::string_body>;
  using Then = std::function<void(bool is_well)>;

  void expect_within(Duration);
  void expect_nothing();
  void wait_for_request();
  void read_head();
  void take_head();
  RequestHead head_of_parser() const;
  void read_body(std::size_t length);
  void make_answer(std::string body);
  void give_refusal(Answer);
  void answer_in_thread(std::string body);
  bool give_pieces_in_thread(const Answer&);
  bool send_from_thread(std::string_view);
  void refuse(boost::system::error_code);
  void give(Answer);
  void send(std::string_view, Then);
  void end_of_answer(bool is_well);
  void finish();
  void drain(std::size_t taken);

  boost::asio::ip::tcp::socket socket_;
  SharedByConnections& shared_;
  boost::asio::steady_timer deadline_;
  std::list<Connection*>::iterator place_;
  boost::beast::flat_buffer buffer_;
  std::optional<Parser> parser_;
  std::optional<BodyParser> body_parser_;
  RequestHead head_;
  std::string out_head_, out_body_;
  std::size_t body_bytes_ = 0;
  bool is_waiting_ = false, is_refused_ = false, is_closed_ = false, has_unread_ = false, is_last_ = false;
  unsigned version_ = 11;

  mutable std::mutex mutex_;  ///< of what follows
  SystemSocket descriptor_;   ///< -1: closed
};

}  // namespace rheocyte

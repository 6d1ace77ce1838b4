// One connection as the server's library reads and writes it: everything has a deadline and a size, so that a slow or
// broken client holds nothing but its own thread, and that not for long.
#pragma once
#include <httplib.h>
#include <poll.h>

#include <array>
#include <chrono>
#include <functional>

#include "view/http.h"

namespace rheocyte {

class Connection final : public httplib::Stream, public Client {
 public:
  /// A connection without requests is closed after this.
  static constexpr std::chrono::seconds idle_time{60};

  /// Owns the socket.
  explicit Connection(int socket);
  ~Connection() override;
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;

  /// Until the first byte of a request. False: the client is gone or silent for too long, or nobody wants to wait.
  bool wait_for_request(const std::function<bool()>& goes_on);
  /// From here on a head may come, and once it is read a body of so many bytes.
  void begin_head();
  void begin_body(std::size_t bytes);
  /// A body that is announced and not read would be taken for the next request: this one is the last.
  void make_last() { is_last_ = true; }
  bool is_last() const { return is_last_; }
  /// Nothing more is written. What still comes is read away for a moment, so that the last answer reaches a client that
  /// is sending.
  void finish();

  bool has_left() const override;

  bool takes_gzip = false;  ///< the client, with the request that is being answered

  bool is_readable() const override { return available() > 0 || wait(POLLIN, {}); }
  bool is_writable() const override { return !has_left(); }
  ssize_t read(char* to, size_t size) override;
  ssize_t write(const char* from, size_t size) override;
  void get_remote_ip_and_port(std::string& ip, int& port) const override;
  void get_local_ip_and_port(std::string& ip, int& port) const override;
  socket_t socket() const override { return socket_; }

 private:
  using Clock = std::chrono::steady_clock;

  std::size_t available() const { return end_ - begin_; }
  /// Whether the socket has one of the events before the time has gone.
  bool wait(short events, Clock::duration) const;
  bool fill();

  int socket_;
  bool is_last_ = false;
  std::size_t allowed_ = 0;  ///< bytes that may still be read
  Clock::time_point deadline_;
  std::array<char, 16384> buffer_;
  std::size_t begin_ = 0, end_ = 0;
};

}  // namespace rheocyte

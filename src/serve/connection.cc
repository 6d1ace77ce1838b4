#include "serve/connection.h"

#include <fmt/format.h>

#include <boost/asio/buffer.hpp>
#include <boost/asio/executor_work_guard.hpp>
#include <boost/asio/post.hpp>
#include <boost/beast/http/error.hpp>
#include <boost/beast/http/read.hpp>
#include <cstdint>
#include <future>
#include <limits>
#include <utility>

#include "serve/answer_text.h"
#include "serve/system_sockets.h"

namespace rheocyte {

namespace {

using namespace std::chrono_literals;
namespace protocol = boost::beast::http;
using boost::asio::ip::tcp;
using boost::system::error_code;

constexpr auto idle_time = 60s, head_time = 10s, body_time = 30s, write_time = 20s, drain_time = 2s;
constexpr std::size_t max_head = 64 << 10, max_drain = 64 << 20, read_at_once = 16 << 10;
/// Of all connections together.
constexpr std::size_t max_bodies = 64 << 20;

std::string_view reason_of(int status) {
  const auto phrase = protocol::obsolete_reason(protocol::int_to_status(static_cast<unsigned>(status)));
  return {phrase.data(), phrase.size()};
}

bool is_fault_of_protocol(const error_code& error) {
  return error.category() == make_error_code(protocol::error::bad_value).category() &&
         error != protocol::error::end_of_stream && error != protocol::error::partial_message;
}

std::string in_small_letters_of(boost::beast::string_view name) {
  std::string small(name);
  for (char& c : small)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return small;
}

}  // namespace

Connection::Connection(tcp::socket socket, SharedByConnections& shared)
    : socket_(std::move(socket)),
      shared_(shared),
      deadline_(socket_.get_executor()),
      place_(shared.open.insert(shared.open.end(), this)),
      descriptor_(static_cast<SystemSocket>(socket_.native_handle())) {
  error_code ignored;
  socket_.set_option(tcp::no_delay(true), ignored);  // head and body are two small packets
}

void Connection::begin() { wait_for_request(); }

void Connection::close() {
  if (std::exchange(is_closed_, true)) return;
  shared_.open.erase(place_);
  shared_.body_bytes -= std::exchange(body_bytes_, 0);
  expect_nothing();
  const std::scoped_lock lock(mutex_);
  descriptor_ = -1;
  error_code ignored;
  socket_.shutdown(tcp::socket::shutdown_both, ignored);
  socket_.close(ignored);
}

bool Connection::has_left() const {
  const std::scoped_lock lock(mutex_);  // a number that is closed may soon be that of another one
  return descriptor_ < 0 || peer_has_left(descriptor_);
}

void Connection::expect_within(Duration time) {
  deadline_.expires_after(time);
  deadline_.async_wait([weak = weak_from_this()](const error_code& error) {
    const auto self = weak.lock();
    if (!error && self && self->deadline_.expiry() <= std::chrono::steady_clock::now()) self->close();
  });
}

void Connection::expect_nothing() { deadline_.expires_at(std::chrono::steady_clock::time_point::max()); }

void Connection::wait_for_request() {
  if (is_closed_) return;
  is_waiting_ = true;
  if (!is_refused_) shared_.open.splice(shared_.open.end(), shared_.open, place_);
  if (buffer_.size() > 0) return read_head();
  expect_within(idle_time);
  socket_.async_read_some(buffer_.prepare(read_at_once), [self = shared_from_this()](error_code error, std::size_t n) {
    if (error) return self->close();
    self->buffer_.commit(n);
    self->read_head();
  });
}

void Connection::read_head() {
  parser_.emplace();
  parser_->header_limit(max_head);
  parser_->body_limit(std::numeric_limits<std::uint64_t>::max());  // the site decides
  expect_within(head_time);
  protocol::async_read_header(socket_, buffer_, *parser_, [self = shared_from_this()](error_code error, std::size_t) {
    if (error) return self->refuse(error);
    self->take_head();
  });
}

RequestHead Connection::head_of_parser() const {
  const auto& message = parser_->get();
  RequestHead head{.method = std::string(message.method_string()), .target = std::string(message.target())};
  for (const auto& field : message)
    head.headers.emplace_back(in_small_letters_of(field.name_string()), std::string(field.value()));
  error_code ignored;
  head.local_address = socket_.local_endpoint(ignored).address().to_string();
  head.is_of_own_user = [socket = descriptor_] { return peer_is_own_user(socket); };
  return head;
}

void Connection::take_head() {
  head_ = head_of_parser();
  version_ = parser_->get().version();
  is_last_ = !parser_->keep_alive();
  is_waiting_ = is_refused_ = false;
  auto seen = shared_.site.look_at(head_);
  const std::size_t* length = std::get_if<std::size_t>(&seen);
  if (length && *length == 0) return make_answer({});
  if (length && shared_.body_bytes + *length <= max_bodies) return read_body(*length);
  has_unread_ = head_.has_body();
  if (length) return give_refusal(refusal(503, "busy", "Too much is sent to the server at once; try again."));
  auto& answer = std::get<Answer>(seen);
  constexpr int least_refusal = 400;
  if (answer.status >= least_refusal) return give_refusal(std::move(answer));
  give(std::move(answer));
}

// Until it is gone, or asks for something that it may have, it is the first to be closed.
void Connection::give_refusal(Answer answer) {
  is_refused_ = true;
  shared_.open.splice(shared_.open.begin(), shared_.open, place_);
  give(std::move(answer));
}

void Connection::read_body(std::size_t length) {
  body_bytes_ = length;
  shared_.body_bytes += length;
  body_parser_.emplace(std::move(*parser_));
  body_parser_->body_limit(length);
  expect_within(body_time);
  const auto read = [self = shared_from_this()](bool is_well) {
    if (!is_well) return self->close();
    self->expect_within(body_time);
    protocol::async_read(self->socket_, self->buffer_, *self->body_parser_, [self](error_code error, std::size_t) {
      if (error) return self->refuse(error);
      self->make_answer(std::move(self->body_parser_->get().body()));
    });
  };
  const bool waits = head_.first("expect").find("100") != std::string::npos;
  send(waits ? "HTTP/1.1 100 Continue\r\n\r\n" : "", read);
}

void Connection::make_answer(std::string body) {
  expect_nothing();
  auto job = [self = shared_from_this(), server_goes_on = boost::asio::make_work_guard(socket_.get_executor()),
              body = std::move(body)]() mutable { self->answer_in_thread(std::move(body)); };
  if (!shared_.threads.take(std::move(job)))
    give(refusal(503, "busy", "Too many requests wait for their answers; try again."));
}

void Connection::answer_in_thread(std::string body) {
  const auto later = [this](auto then) {
    boost::asio::post(socket_.get_executor(),
                      [self = shared_from_this(), then = std::move(then)]() mutable { then(*self); });
  };
  if (has_left()) return later([](Connection& self) { self.close(); });
  Answer answer = shared_.site.answer(head_, std::move(body), this);
  if (!answer.give_pieces || head_.method == "HEAD")
    return later([answer = std::move(answer)](Connection& self) mutable { self.give(std::move(answer)); });
  const bool is_well = give_pieces_in_thread(answer);
  later([is_well](Connection& self) { self.end_of_answer(is_well); });
}

bool Connection::give_pieces_in_thread(const Answer& answer) {
  const bool in_pieces = version_ >= 11;
  if (!in_pieces) is_last_ = true;
  bool is_well = send_from_thread(
      head_text(answer, reason_of(answer.status), in_pieces ? Length::pieces : Length::unknown, is_last_));
  try {
    answer.give_pieces([&](std::string_view piece) {
      if (is_well && !piece.empty())
        is_well = send_from_thread(in_pieces ? fmt::format("{:x}\r\n{}\r\n", piece.size(), piece) : std::string(piece));
      return is_well;
    });
  } catch (const std::exception&) {  // too late for a status: the connection ends without the last piece
    return false;
  }
  return is_well && send_from_thread(in_pieces ? "0\r\n\r\n" : "");
}

bool Connection::send_from_thread(std::string_view text) {
  const auto is_sent = std::make_shared<std::promise<bool>>();
  boost::asio::post(socket_.get_executor(), [self = shared_from_this(), text, is_sent] {
    self->send(text, [is_sent](bool is_well) { is_sent->set_value(is_well); });
  });
  return is_sent->get_future().get();
}

void Connection::refuse(error_code error) {
  if (!is_fault_of_protocol(error)) return close();
  head_ = {};
  is_waiting_ = false;
  has_unread_ = true;
  give_refusal(error == protocol::error::header_limit ? refusal(431, "size", "The head of the request is too long.")
                                                      : refusal(400, "request", "The request cannot be understood."));
}

void Connection::give(Answer answer) {
  constexpr int not_modified = 304;
  if (has_unread_) is_last_ = true;  // what is announced and not read would be taken for the next request
  out_head_ =
      head_text(answer, reason_of(answer.status), answer.give_pieces ? Length::pieces : Length::known, is_last_);
  out_body_ = head_.method == "HEAD" || answer.status == not_modified ? std::string() : std::move(answer.body);
  send(out_head_, [self = shared_from_this()](bool is_well) {
    if (!is_well) return self->close();
    self->send(self->out_body_, [self](bool is_all) { self->end_of_answer(is_all); });
  });
}

void Connection::send(std::string_view text, Then then) {
  if (text.empty()) {
    expect_nothing();
    return then(true);
  }
  expect_within(write_time);
  socket_.async_write_some(
      boost::asio::buffer(text.data(), text.size()),
      [self = shared_from_this(), text, then = std::move(then)](error_code error, std::size_t n) mutable {
        if (error) return then(false);
        self->send(text.substr(n), std::move(then));
      });
}

void Connection::end_of_answer(bool is_well) {
  if (!is_well) return close();
  shared_.body_bytes -= std::exchange(body_bytes_, 0);
  body_parser_.reset();
  out_body_ = {};
  if (is_last_) return finish();
  wait_for_request();
}

// What still comes is read away for a moment, so that the last answer reaches a client that is sending.
void Connection::finish() {
  error_code ignored;
  socket_.shutdown(tcp::socket::shutdown_send, ignored);
  if (!has_unread_) return close();
  expect_within(drain_time);
  drain(0);
}

void Connection::drain(std::size_t taken) {
  buffer_.clear();
  socket_.async_read_some(buffer_.prepare(read_at_once),
                          [self = shared_from_this(), taken](error_code error, std::size_t n) {
                            if (error || taken + n > max_drain) return self->close();
                            self->drain(taken + n);
                          });
}

}  // namespace rheocyte

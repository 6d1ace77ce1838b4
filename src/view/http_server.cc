#include "view/http_server.h"

#include <fmt/format.h>
#include <sys/socket.h>
#include <unistd.h>

#include <atomic>
#include <mutex>
#include <set>

#include "case/user_error.h"
#include "view/access.h"
#include "view/connection.h"
#include "view/connection_threads.h"

namespace rheocyte {

namespace {

constexpr int most_waiting_connections = 128;
constexpr std::size_t longest_target = 4096;

constexpr const char* content_policy =
    "default-src 'self'; img-src 'self' blob: data:; style-src 'self'; worker-src 'self' blob:; object-src 'none'; "
    "base-uri 'none'; form-action 'none'; frame-ancestors 'none'";

/// The connection that this thread serves: the library hands no user's data through.
thread_local Connection* current = nullptr;

std::vector<std::string> headers_named(const char* name, const httplib::Request& request) {
  std::vector<std::string> values;
  const auto [begin, end] = request.headers.equal_range(name);
  for (auto header = begin; header != end; ++header) values.push_back(header->second);
  return values;
}

Credentials credentials_of(const httplib::Request& request) {
  return {.hosts = headers_named("Host", request),
          .origins = headers_named("Origin", request),
          .authorization = request.get_header_value("Authorization"),
          .cookie = request.get_header_value("Cookie"),
          .local_address = request.local_addr};
}

Request plain_request(const httplib::Request& from) {
  Request request{.method = from.method == "HEAD" ? "GET" : from.method, .path = from.path, .body = from.body};
  for (const auto& [name, value] : from.params) request.query.insert_or_assign(name, value);
  request.client = current;
  return request;
}

void give(Answer answer, httplib::Response& response) {
  response.status = answer.status;
  for (const auto& [name, value] : answer.headers) response.set_header(name, value);
  if (!answer.give_pieces) {
    response.set_header("Content-Type", answer.type);
    response.body = std::move(answer.body);
    return;
  }
  response.set_chunked_content_provider(
      answer.type, [give_pieces = std::move(answer.give_pieces)](std::size_t, httplib::DataSink& sink) {
        try {
          give_pieces([&](std::string_view piece) { return piece.empty() || sink.write(piece.data(), piece.size()); });
        } catch (const std::exception&) {  // too late for a status: the connection ends without the last piece
          return false;
        }
        sink.done();
        return true;
      });
}

bool has_body(const httplib::Request& request) {
  const std::size_t lengths = request.get_header_value_count("Content-Length");
  return request.has_header("Transfer-Encoding") || lengths > 1 ||
         (lengths == 1 && request.get_header_value("Content-Length") != "0");
}

/// What a body must be like to be read at all; nothing if it is.
std::optional<Answer> refusal_of_body(const httplib::Request& request, std::size_t limit) {
  if (request.has_header("Transfer-Encoding"))
    return refusal(411, "size", "The length of the body must be given, not pieces of it.");
  if (request.has_header("Content-Encoding")) return refusal(415, "type", "The body must not be compressed.");
  const std::string length = request.get_header_value("Content-Length");
  if (length.empty()) return std::nullopt;
  const bool is_number = length.size() < 16 && length.find_first_not_of("0123456789") == std::string::npos;
  if (!is_number || request.get_header_value_count("Content-Length") > 1)
    return refusal(400, "size", "The length of the body is no number.");
  if (std::stoull(length) > limit)
    return refusal(413, "size", fmt::format("The body is longer than the {} bytes that are taken here.", limit));
  return std::nullopt;
}

}  // namespace

/// The library reads and writes the protocol. Which connection may ask, how long it takes and who answers is decided
/// here: before the body is read, and without the library's ranges, forms, files and compression.
class HttpServer::Library final : public httplib::Server {
 public:
  Library(const Router& router, const Assets& assets) : router_(router), assets_(assets) {
    new_task_queue = [this] { return threads_ = new ConnectionThreads; };
    set_socket_options([](socket_t socket) {  // without SO_REUSEPORT two servers would share a port
      const int on = 1;
      ::setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);
    });
    set_keep_alive_timeout(std::chrono::seconds(Connection::idle_time).count());  // it only tells them
    set_keep_alive_max_count(1000);
    set_default_headers({{"Content-Security-Policy", content_policy},
                         {"X-Content-Type-Options", "nosniff"},
                         {"Referrer-Policy", "no-referrer"},
                         {"Cross-Origin-Resource-Policy", "same-origin"},
                         {"Cross-Origin-Opener-Policy", "same-origin"}});
    set_pre_routing_handler([this](const auto& request, auto& response) { return before_body(request, response); });
    const Handler handler = [this](const httplib::Request& request, httplib::Response& response) {
      give(router_.answer(plain_request(request)), response);
    };
    Post(".*", handler).Put(".*", handler).Patch(".*", handler).Delete(".*", handler);
    set_error_handler([](const httplib::Request&, httplib::Response& response) {
      if (!response.body.empty()) return;
      current->make_last();
      give(refusal(response.status, "request", "The request cannot be understood."), response);
    });
  }

  void take_port(const ServedPlace& place, const std::string& token) {
    port_ = place.port == 0 ? bind_to_any_port(place.host) : bind_to_port(place.host, place.port) ? place.port : -1;
    if (port_ <= 0)
      throw UserError(
          place.port == 0
              ? fmt::format("rheocyte view: --host {} is no address of this machine.", one_line(place.host, 80))
              : fmt::format("rheocyte view: port {} of {} cannot be taken, another program may use it; give another "
                            "one with --port, or none for any that is free.",
                            place.port, one_line(place.host, 80)));
    listening_ = svr_sock_;
    ::listen(listening_, most_waiting_connections);
    access_.emplace(token, place.host, port_);
  }

  const Access& access() const { return *access_; }
  int port() const { return port_; }

  ~Library() override {
    if (listening_ >= 0) ::close(listening_);
  }

  void close_all() {
    svr_sock_ = INVALID_SOCKET;  // stop() of the library does nothing before run() has begun
    ::shutdown(listening_, SHUT_RDWR);
    const std::scoped_lock lock(mutex_);
    for (const int socket : open_) ::shutdown(socket, SHUT_RDWR);
  }

 private:
  bool process_and_close_socket(socket_t socket) override {
    {
      const std::scoped_lock lock(mutex_);
      open_.insert(socket);
    }
    serve(socket);
    return true;
  }

  void serve(socket_t socket) {
    Connection connection(socket);
    current = &connection;
    const auto goes_on = [this] { return svr_sock_ != INVALID_SOCKET && !threads_.load()->is_short(); };
    bool is_closed = false;
    while (!is_closed && !connection.is_last() && connection.wait_for_request(goes_on)) {
      connection.begin_head();
      if (!process_request(connection, false, is_closed, leave_to_us)) break;
    }
    connection.finish();
    const std::scoped_lock lock(mutex_);  // not after the close, when the number may belong to another one
    open_.erase(socket);
  }

  /// Ranges, forms, parts and compression: what the library would do by itself.
  static void leave_to_us(httplib::Request& request) {
    current->takes_gzip = request.get_header_value("Accept-Encoding").find("gzip") != std::string::npos;
    request.ranges.clear();
    request.headers.erase("Accept-Encoding");
    request.headers.erase("Content-Type");
  }

  HandlerResponse before_body(const httplib::Request& request, httplib::Response& response) {
    if (auto refused = refusal_before_body(request)) {
      if (has_body(request)) current->make_last();
      give(std::move(*refused), response);
      return HandlerResponse::Handled;
    }
    if (has_body(request)) {
      current->begin_body(std::stoull(request.get_header_value("Content-Length")));
      return HandlerResponse::Unhandled;
    }
    give(answer_without_body(request), response);
    return HandlerResponse::Handled;
  }

  std::optional<Answer> refusal_before_body(const httplib::Request& request) {
    if (request.target.size() > longest_target) return refusal(414, "size", "The address is too long.");
    const bool signs_in = request.method == "GET" && request.path == "/" && request.has_param("token");
    if (signs_in) return access_->sign_in(credentials_of(request), request.get_param_value("token"));
    if (auto refused = access_->refusal_of(credentials_of(request))) return refused;
    const auto limit = router_.body_limit(request.method, request.path);
    if (has_body(request) && !limit) return router_.answer(plain_request(request));
    return refusal_of_body(request, limit.value_or(0));
  }

  Answer answer_without_body(const httplib::Request& request) const {
    const bool reads = request.method == "GET" || request.method == "HEAD";
    if (!reads || !assets_.has(request.path)) return router_.answer(plain_request(request));
    return assets_.answer(request.path, current->takes_gzip, request.get_header_value("If-None-Match"));
  }

  const Router& router_;
  const Assets& assets_;
  std::optional<Access> access_;
  int port_ = -1, listening_ = -1;
  std::atomic<ConnectionThreads*> threads_ = nullptr;  ///< of the library, while it runs
  std::mutex mutex_;
  std::set<int> open_;
};

HttpServer::HttpServer(const Router& router, const Assets& assets, const ServedPlace& place, const std::string& token)
    : library_(std::make_unique<Library>(router, assets)) {
  library_->take_port(place, token);
}

HttpServer::~HttpServer() = default;

std::string HttpServer::address() const { return library_->access().address(); }
int HttpServer::port() const { return library_->port(); }
void HttpServer::run() { library_->listen_after_bind(); }
void HttpServer::stop() { library_->close_all(); }

}  // namespace rheocyte

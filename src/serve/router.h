// Which function answers which path.
#pragma once
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "serve/http.h"

namespace rheocyte {

/// Of a request's body, in bytes.
inline constexpr std::size_t usual_body_limit = std::size_t(1) << 20, big_body_limit = std::size_t(16) << 20;

/// Filled before the server starts, unchanged afterwards; its functions are called by many threads at once.
class Router {
 public:
  using Handler = std::function<Answer(const Request&)>;
  /// A sentence to the user as the page has it.
  using Words = std::function<std::string(const std::string&)>;

  Router() = default;
  explicit Router(Words words) : words_(std::move(words)) {}

  /// For example: add("GET", "/api/items/{item}/events/{event}", ...); a part in braces holds no slash.
  void add(std::string_view method, std::string_view pattern, Handler, std::size_t body_limit = usual_body_limit);

  /// Nothing where no one answers.
  std::optional<std::size_t> body_limit(std::string_view method, std::string_view path) const;

  /// Never throws: what a handler throws becomes an answer, and an unknown path, or one with another method, too.
  Answer answer(Request) const;

 private:
  struct Route {
    std::string method;
    std::vector<std::string> pattern;
    Handler handler;
    std::size_t body_limit;
  };
  const Route* find(std::string_view method, std::string_view path, Request::Names* parts) const;
  bool knows(std::string_view path) const;

  std::vector<Route> routes_;
  Words words_;
};

}  // namespace rheocyte

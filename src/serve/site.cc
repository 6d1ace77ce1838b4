#include "serve/site.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <optional>

#include "serve/target.h"

namespace rheocyte {

namespace {

constexpr std::size_t longest_target = 4096;

Credentials credentials_of(const RequestHead& head) {
  return {.hosts = head.all("host"),
          .origins = head.all("origin"),
          .authorization = head.first("authorization"),
          .cookie = head.first("cookie"),
          .local_address = head.local_address,
          .is_of_own_user = head.is_of_own_user};
}

/// HEAD is answered as GET; the body is left out when it is written.
std::string method_of(const RequestHead& head) { return head.method == "HEAD" ? "GET" : head.method; }

/// What a body must be like to be read at all: its length if it is.
std::variant<Answer, std::size_t> length_of_body(const RequestHead& head, std::size_t limit) {
  if (!head.all("transfer-encoding").empty())
    return refusal(411, "size", "The length of the body must be given, not pieces of it.");
  if (!head.all("content-encoding").empty()) return refusal(415, "type", "The body must not be compressed.");
  const std::string text = head.first("content-length");
  std::size_t length = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), length);
  if (error != std::errc() || end != text.data() + text.size() || head.all("content-length").size() > 1)
    return refusal(400, "size", "The length of the body is not a number.");
  if (length > limit)
    return refusal(413, "size", fmt::format("The body is longer than the {} bytes that are taken here.", limit));
  return length;
}

}  // namespace

std::vector<std::string> RequestHead::all(std::string_view name) const {
  std::vector<std::string> values;
  for (const auto& [known, value] : headers)
    if (known == name) values.push_back(value);
  return values;
}

std::string RequestHead::first(std::string_view name) const {
  const auto found = std::ranges::find(headers, name, &std::pair<std::string, std::string>::first);
  return found == headers.end() ? "" : found->second;
}

bool RequestHead::has_body() const {
  const std::vector<std::string> lengths = all("content-length");
  return !all("transfer-encoding").empty() || lengths.size() > 1 || (lengths.size() == 1 && lengths.front() != "0");
}

std::variant<Answer, std::size_t> Site::look_at(const RequestHead& head) const {
  if (head.target.size() > longest_target) return refusal(414, "size", "The address is too long.");
  const Credentials who = credentials_of(head);
  if (head.method == "GET" && head.target.starts_with("/?")) {
    const Request::Names query = read_target(head.target).query;
    if (const auto token = query.find("token"); token != query.end()) return access_.sign_in(who, token->second);
    if (const auto once = query.find("once"); once != query.end()) return access_.sign_in_once(who, once->second);
  }
  if (auto refused = access_.refusal_of(who)) return *std::move(refused);
  const std::string path = read_target(head.target).path;
  if (head.has_body()) {
    const auto limit = router_.body_limit(method_of(head), path);
    if (!limit) return router_.answer({.method = method_of(head), .path = path});  // 404 or 405
    return length_of_body(head, *limit);
  }
  if (method_of(head) != "GET" || !assets_.has(path)) return std::size_t{0};
  const bool takes_gzip = head.first("accept-encoding").find("gzip") != std::string::npos;
  return assets_.answer(path, takes_gzip, head.first("if-none-match"));
}

Answer Site::answer(const RequestHead& head, std::string body, const Client* client) const {
  Target target = read_target(head.target);
  return router_.answer({.method = method_of(head),
                         .path = std::move(target.path),
                         .query = std::move(target.query),
                         .body = std::move(body),
                         .client = client});
}

}  // namespace rheocyte

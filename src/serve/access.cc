#include "serve/access.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <random>

namespace rheocyte {

namespace {

constexpr std::string_view no_token =
    "This address needs the token: open the address that `rheocyte view` has printed.";

/// Takes the same time wherever the texts differ.
bool are_equal(std::string_view a, std::string_view b) {
  unsigned difference = a.size() == b.size() ? 0 : 1;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i)
    difference |= static_cast<unsigned char>(a[i]) ^ static_cast<unsigned char>(b[i]);
  return difference == 0;
}

std::string in_small_letters(std::string_view text) {
  std::string small(text);
  std::ranges::transform(small, small.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return small;
}

/// An address with colons stands in brackets.
std::string named(std::string_view host, int port) {
  const bool is_ipv6 = host.find(':') != std::string_view::npos;
  return fmt::format("{}{}{}:{}", is_ipv6 ? "[" : "", host, is_ipv6 ? "]" : "", port);
}

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t");
  return first == std::string_view::npos ? "" : text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

/// The value of a cookie; empty without it.
std::string_view cookie_named(std::string_view name, std::string_view cookies) {
  while (!cookies.empty()) {
    const std::size_t end = std::min(cookies.find(';'), cookies.size());
    const std::string_view one = trimmed(cookies.substr(0, end));
    if (one.size() > name.size() && one.starts_with(name) && one[name.size()] == '=')
      return one.substr(name.size() + 1);
    cookies.remove_prefix(std::min(end + 1, cookies.size()));
  }
  return {};
}

}  // namespace

std::string new_token() {
  std::random_device random;
  std::string token;
  for (int i = 0; i < 4; ++i) token += fmt::format("{:08x}", random());
  return token;
}

Access::Access(std::string token, std::string host, int port)
    : token_(std::move(token)), host_(std::move(host)), port_(port) {}

std::string Access::address_of_once() const { return fmt::format("http://{}/?once={}", named(host_, port_), once_); }

std::string Access::address() const { return fmt::format("http://{}/?token={}", named(host_, port_), token_); }

bool Access::is_ours(std::string_view host, std::string_view local_address) const {
  const std::string asked = in_small_letters(host);
  for (const std::string_view name : {std::string_view("127.0.0.1"), std::string_view("localhost"),
                                      std::string_view("::1"), std::string_view(host_), local_address})
    if (asked == named(in_small_letters(name), port_)) return true;
  return false;
}

std::optional<Answer> Access::refusal_of_names(const Credentials& who) const {
  if (who.hosts.size() != 1) return refusal(400, "host", "The request needs one header Host.");
  if (!is_ours(who.hosts.front(), who.local_address))
    return refusal(403, "host", "The request is for another host; open the address that `rheocyte view` has printed.");
  for (const std::string& origin : who.origins) {
    constexpr std::string_view scheme = "http://";
    if (!origin.starts_with(scheme) || !is_ours(std::string_view(origin).substr(scheme.size()), who.local_address))
      return refusal(403, "origin", "Pages of other sites may not use this server.");
  }
  return std::nullopt;
}

bool Access::has_token(const Credentials& who) const {
  constexpr std::string_view scheme = "Bearer ";
  const std::string_view authorization = who.authorization;
  if (authorization.starts_with(scheme)) return are_equal(trimmed(authorization.substr(scheme.size())), token_);
  return are_equal(cookie_named(fmt::format("rheocyte_{}", port_), who.cookie), token_);
}

std::optional<Answer> Access::refusal_of(const Credentials& who) const {
  if (auto refused = refusal_of_names(who)) return refused;
  if (!has_token(who)) return refusal(401, "token", no_token);
  return std::nullopt;
}

Answer Access::welcome() const {
  const std::string cookie = fmt::format("rheocyte_{}={}; HttpOnly; SameSite=Strict; Path=/", port_, token_);
  return {.status = 303, .type = "text/plain", .headers = {{"Location", "/"}, {"Set-Cookie", cookie}}};
}

Answer Access::sign_in(const Credentials& who, std::string_view token) const {
  if (auto refused = refusal_of_names(who)) return *refused;
  if (!are_equal(token, token_)) return refusal(401, "token", no_token);
  return welcome();
}

Answer Access::sign_in_once(const Credentials& who, std::string_view key) {
  if (auto refused = refusal_of_names(who)) return *refused;
  if (has_token(who)) return welcome();  // a browser that asks twice
  if (once_is_used_ || !are_equal(key, once_) || !who.is_of_own_user || !who.is_of_own_user())
    return refusal(401, "token", no_token);
  once_is_used_ = true;
  return welcome();
}

}  // namespace rheocyte

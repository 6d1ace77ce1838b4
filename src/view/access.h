// Who may ask: whoever knows the token and talks to this server by its own name (docs/view.md, sec. access).
#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "view/http.h"

namespace rheocyte {

/// 128 random bits as 32 hexadecimal digits.
std::string new_token();

/// What the head of a request says about its sender.
struct Credentials {
  std::vector<std::string> hosts, origins;  ///< the headers of these names
  std::string authorization, cookie;
  std::string local_address;  ///< at which the connection was accepted: "127.0.0.1"
};

class Access {
 public:
  /// `host` is the address that is served, as the user has given it.
  Access(std::string token, std::string host, int port);

  /// Nothing if the sender may ask; otherwise 400 (no Host, or several), 403 (another Host or a foreign Origin: a page
  /// of somebody else asks through the user's browser) or 401 (no token, or a wrong one).
  std::optional<Answer> refusal_of(const Credentials&) const;

  /// The same of GET /?token=..., which brings the token in the query: 303 to / with the cookie.
  Answer sign_in(const Credentials&, std::string_view token) const;

  /// http://127.0.0.1:PORT/?token=TOKEN
  std::string address() const;

 private:
  std::optional<Answer> refusal_of_names(const Credentials&) const;
  bool is_ours(std::string_view host, std::string_view local_address) const;
  bool has_token(const Credentials&) const;

  std::string token_, host_;
  int port_;
};

}  // namespace rheocyte

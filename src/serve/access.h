// Who may ask: anyone who knows the token and talks to this server by its own name (docs/view.md, sec. access).
#pragma once
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "serve/http.h"

namespace rheocyte {

/// 128 random bits as 32 hexadecimal digits.
std::string new_token();

/// What the head of a request says about its sender.
struct Credentials {
  std::vector<std::string> hosts, origins;  ///< the headers of these names
  std::string authorization, cookie;
  std::string local_address;  ///< at which the connection was accepted: "127.0.0.1"
  /// Whether a program of the user who runs this server has sent it, as far as the system reports. Nothing: it does
  /// not.
  std::function<bool()> is_of_own_user = {};
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

  /// GET /?once=..., with the key that is for the browser that the server starts: 303 as sign_in(), for the first
  /// sender alone, and only if it is a program of the same user. Other users see the key in the list of processes.
  Answer sign_in_once(const Credentials&, std::string_view key);

  /// http://127.0.0.1:PORT/?token=TOKEN
  std::string address() const;
  /// http://127.0.0.1:PORT/?once=KEY
  std::string address_of_once() const;

 private:
  std::optional<Answer> refusal_of_names(const Credentials&) const;
  bool is_ours(std::string_view host, std::string_view local_address) const;
  bool has_token(const Credentials&) const;
  Answer welcome() const;

  std::string token_, host_, once_ = new_token();
  bool once_is_used_ = false;
  int port_;
};

}  // namespace rheocyte

// What the server answers, without sockets: who may ask, what a body must be like, the page, and the router.
#pragma once
#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "serve/access.h"
#include "serve/assets.h"
#include "serve/router.h"

namespace rheocyte {

/// What comes before the body of a request. Nothing of it is interpreted yet.
struct RequestHead {
  std::string method, target;
  std::vector<std::pair<std::string, std::string>> headers = {};  ///< names in small letters
  std::string local_address = {};                                 ///< see Credentials
  std::function<bool()> is_of_own_user = {};

  std::vector<std::string> all(std::string_view name) const;
  /// The first of the headers of this name, empty without one.
  std::string first(std::string_view name) const;
  /// Whether a body is announced, be it a wrong one.
  bool has_body() const;
};

/// For the threads of the server. Router and page must outlive it.
class Site {
 public:
  Site(const Router& router, const Assets& assets, Access& access)
      : router_(router), assets_(assets), access_(access) {}

  /// Access first; then either the answer, because the request is refused or no work, or the length of the body that is
  /// to be read before it is answered.
  std::variant<Answer, std::size_t> look_at(const RequestHead&) const;

  /// The answer to a request that may ask, with its body. May take its time; see Router::answer.
  Answer answer(const RequestHead&, std::string body, const Client*) const;

 private:
  const Router& router_;
  const Assets& assets_;
  Access& access_;
};

}  // namespace rheocyte

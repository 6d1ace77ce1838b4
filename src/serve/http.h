// What a page or a script asks and what it gets, as those who answer see it: no sockets, no library of a server.
#pragma once
#include <chrono>
#include <cstddef>
#include <functional>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "store/watch.h"

namespace rheocyte {

/// The other end of a connection.
class Client {
 public:
  virtual ~Client() = default;
  /// Whether it has hung up; what is computed for it is then in vain.
  virtual bool has_left() const = 0;
  /// So often who waits for what is computed asks that.
  static constexpr std::chrono::milliseconds asked_every{10};
};

struct Request {
  using Names = std::map<std::string, std::string, std::less<>>;

  std::string method;  ///< "GET", "POST", "PUT", "PATCH" or "DELETE"
  std::string path;    ///< without the query, percent-decoded
  Names parts = {};    ///< of the path, by the names in the braces of its pattern
  Names query = {};
  std::string body = {};           ///< no longer than the route allows
  const Client* client = nullptr;  ///< while the answer is made; no one in some tests

  bool client_has_left() const { return client && client->has_left(); }
  /// Of the thread that computes for the client.
  Watch watch() const {
    return {.stop = [client = client] { return client && client->has_left(); }};
  }
  /// The whole number that stands in the path at {name}. Refused (404) if it is none.
  std::size_t number(std::string_view name) const;
  /// A value of the query.
  std::string asked(std::string_view name, std::string_view otherwise = {}) const;
  /// The body as a tree, an object. Refused (400) if it is none.
  nlohmann::ordered_json json() const;
};

/// Takes the next piece of a body; false: the client has left, or stop for another reason.
using TakePiece = std::function<bool(std::string_view)>;

struct Answer {
  int status = 200;
  std::string type = "application/json";
  std::string body = {};
  std::vector<std::pair<std::string, std::string>> headers = {};  ///< beside those that every answer has
  /// Instead of the body: called once the header is sent, gives one piece after another.
  std::function<void(const TakePiece&)> give_pieces = {};
};

/// A request that is answered with an error: thrown where it is found, sent by the server as
/// {"error": sentence, "reason": word}. A UserError becomes 400 with the reason "input".
class Refused : public std::runtime_error {
 public:
  Refused(int status, std::string_view reason, const std::string& sentence);
  int status;
  std::string reason;
};

/// One line of JSON.
Answer json_answer(const nlohmann::ordered_json&, int status = 200);
Answer refusal(int status, std::string_view reason, std::string_view sentence);

}  // namespace rheocyte

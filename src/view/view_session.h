// What a page wants to find again: GET and PUT /api/session, and the file session.toml.
#pragma once
#include <filesystem>
#include <functional>
#include <mutex>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "serve/router.h"
#include "view/export_folder.h"

namespace rheocyte {

/// Something that the server keeps in the session beside the page's own content, for example the items.
struct SessionPart {
  std::string name;                                            ///< key in the session, "items"
  std::function<nlohmann::ordered_json()> kept;                ///< as it is now
  std::function<void(const nlohmann::ordered_json&)> restore;  ///< UserError
};

/// For several threads at once.
class ViewSession {
 public:
  /// Whether a file begins as those that a view has written.
  static bool is_session(const std::filesystem::path& file);
  void add(SessionPart);
  /// Restores from session.toml. UserError.
  void read(const std::filesystem::path& file);
  /// The text of session.toml.
  std::string text() const;
  void add_routes(Router&, Exports&);

 private:
  mutable std::mutex mutex_;
  nlohmann::ordered_json page_ = nlohmann::ordered_json::object();
  std::vector<SessionPart> parts_;
};

}  // namespace rheocyte

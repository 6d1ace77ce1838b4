// The only place that the view writes to.
#pragma once
#include <filesystem>
#include <functional>
#include <map>
#include <mutex>
#include <nlohmann/json_fwd.hpp>
#include <set>
#include <string>
#include <string_view>

#include "view/router.h"

namespace rheocyte {

/// Files go into one folder, and never over one that this view did not write. For several threads at once.
class ExportFolder {
 public:
  /// UserError if nothing can be written there; the folder is made.
  explicit ExportFolder(const std::filesystem::path&);

  const std::filesystem::path& path() const { return folder_; }

  /// Where a file, or a folder, of this name goes; afterwards it counts as written by this view. Refused (400) if the
  /// name is none, holds a folder or is hidden, (409) if something stands there that this view did not write.
  std::filesystem::path claim(std::string_view name);

  /// Writes a file whole or not at all and returns its path. Refused as claim() is, and (507) if it cannot be written.
  std::filesystem::path write(std::string_view name, std::string_view content);

 private:
  std::filesystem::path folder_;
  std::mutex mutex_;
  std::set<std::filesystem::path> written_;
};

/// POST /api/export: what is exported is chosen by "what" in the request.
class Exports {
 public:
  /// Returns the path of what it has written.
  using Export = std::function<std::filesystem::path(const nlohmann::ordered_json& request, ExportFolder&)>;

  explicit Exports(ExportFolder& folder) : folder_(folder) {}
  void add(std::string what, Export);
  void add_route(Router&);

 private:
  ExportFolder& folder_;
  std::map<std::string, Export, std::less<>> exports_;
};

}  // namespace rheocyte

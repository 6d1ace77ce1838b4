// The only place that the view writes to.
#pragma once
#include <filesystem>
#include <functional>
#include <map>
#include <mutex>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <set>
#include <string>
#include <string_view>

#include "serve/few_at_once.h"
#include "serve/router.h"
#include "store/system_files.h"

namespace rheocyte {

class ExportFolder;

enum class ExportKind { file, folder };

/// The name of an export that is under way: no one else in this view has it meanwhile.
class ExportPlace {
 public:
  /// Refused, see ExportFolder::claim.
  ExportPlace(ExportFolder&, std::filesystem::path, ExportKind);
  ~ExportPlace();
  ExportPlace(const ExportPlace&) = delete;
  ExportPlace& operator=(const ExportPlace&) = delete;

  const std::filesystem::path& path() const { return path_; }
  /// A hidden name beside it at which nothing stands: a file is written there and then published.
  const std::filesystem::path& scratch() const { return scratch_; }

  /// Refused (409) if something stands in the place that this view has not written, or that was changed since.
  void check() const;
  /// Puts the file from the hidden name in the place. Refused as check(), and (507) if that fails.
  void publish();
  /// What stands in the place now counts as written by this view.
  void keep();

 private:
  ExportFolder& folder_;
  std::filesystem::path path_, scratch_;
  ExportKind kind_;
};

/// Files go into one folder, and never over one that this view did not write. For several threads at once.
class ExportFolder {
 public:
  /// UserError if nothing can be written there; the folder is made.
  explicit ExportFolder(const std::filesystem::path&);

  const std::filesystem::path& path() const { return folder_; }

  /// Where a file, or a folder, of this name goes. Refused (400) if the name is none, holds a folder or is hidden,
  /// (409) if something stands there that this view did not write, or another export of the name is under way.
  ExportPlace claim(std::string_view name, ExportKind kind = ExportKind::file);

  /// Writes a file whole or not at all and returns its path. Refused as claim() is, and (507) if it cannot be written.
  std::filesystem::path write(std::string_view name, std::string_view content);

 private:
  friend class ExportPlace;
  void check(const std::filesystem::path&, ExportKind) const;

  std::filesystem::path folder_;
  mutable std::mutex mutex_;
  std::map<std::filesystem::path, FileFacts> written_;
  std::set<std::filesystem::path> under_way_;
};

/// POST /api/export: what is exported is chosen by "what" in the request.
class Exports {
 public:
  /// `wish` is the body of the request. Returns the path of what it has written. Ends early once the client has left.
  using Export =
      std::function<std::filesystem::path(const nlohmann::ordered_json& wish, const Request&, ExportFolder&)>;

  explicit Exports(ExportFolder& folder) : folder_(folder) {}
  void add(std::string what, Export);
  void add_route(Router&);

 private:
  Answer answer(const Request&);

  ExportFolder& folder_;
  std::map<std::string, Export, std::less<>> exports_;
  FewAtOnce under_way_{4, "Several exports are being written already; wait for their end."};
};

}  // namespace rheocyte

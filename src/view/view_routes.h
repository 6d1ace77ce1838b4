// All that the page may ask for, without a server.
#pragma once
#include <filesystem>
#include <span>
#include <vector>

#include "serve/router.h"
#include "view/export_folder.h"
#include "view/solver_threads.h"
#include "view/view_items.h"
#include "view/view_session.h"

namespace rheocyte {

class ViewRoutes {
 public:
  /// What is exported goes to `output`. To be made while the process has a single thread. UserError of sessions and of
  /// the folder.
  ViewRoutes(std::span<const std::filesystem::path> paths, const std::filesystem::path& output);
  ViewRoutes(const ViewRoutes&) = delete;
  ViewRoutes& operator=(const ViewRoutes&) = delete;

  const Router& router() const { return router_; }
  const ViewItems& items() const { return items_; }
  /// Lists a file or folder, or restores a session. UserError.
  void open(const std::filesystem::path&);

 private:
  ViewItems items_;
  ExportFolder folder_;
  SolverThreads threads_;
  Router router_;
  Exports exports_{folder_};
  ViewSession session_;
};

}  // namespace rheocyte

// `rheocyte view`: a page in the browser on the solver and on recordings, served to this machine (docs/view.md).
#pragma once
#include <filesystem>
#include <vector>

#include "serve/http_server.h"

namespace rheocyte {

struct ViewOptions {
  std::vector<std::filesystem::path> paths;  ///< recordings, folders of them, results, cases, tables, a session.toml
  ServedPlace place;
  bool opens_browser = true;
  std::filesystem::path output = {};  ///< the only folder that is written to; empty: the current one
};

/// Serves until a signal comes. Prints the address on standard output once it answers. UserError.
void serve_view(const ViewOptions&);

}  // namespace rheocyte

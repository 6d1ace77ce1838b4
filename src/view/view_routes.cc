#include "view/view_routes.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "store/thread.h"
#include "view/page_words.h"
#include "view/path_text.h"
#include "view/view_part.h"

namespace rheocyte {

namespace {

namespace fs = std::filesystem;

/// Of what each thread's session keeps; a ladder of meshes for one cell takes a tenth of it.
constexpr std::size_t session_bytes = std::size_t(48) << 20;

std::vector<fs::path> without_sessions(std::span<const fs::path> paths) {
  std::vector<fs::path> others;
  std::ranges::remove_copy_if(paths, std::back_inserter(others), &ViewSession::is_session);
  return others;
}

}  // namespace

ViewRoutes::ViewRoutes(std::span<const fs::path> paths, const fs::path& output)
    : items_(without_sessions(paths)),
      folder_(output),
      threads_(processors(), session_bytes),
      router_(in_words_of_page) {
  for (const ViewPart* const part : view_parts()) part->add_routes({router_, exports_, session_, items_, threads_});
  session_.add_routes(router_, exports_);
  exports_.add_route(router_);
  for (const fs::path& path : paths)
    if (ViewSession::is_session(path)) session_.read(path);
}

void ViewRoutes::open(const fs::path& path) {
  if (ViewSession::is_session(path)) return session_.read(path);
  items_.restore(nlohmann::ordered_json::array({{{"path", path_text(path)}}}));
}

}  // namespace rheocyte

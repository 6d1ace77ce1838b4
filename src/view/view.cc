#include "view/view.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <optional>
#include <thread>
#include <utility>

#include "serve/access.h"
#include "serve/open_browser.h"
#include "store/standard_error.h"
#include "store/standard_output.h"
#include "store/stop_signal.h"
#include "store/thread.h"
#include "view/cell_routes.h"
#include "view/declarations.h"
#include "view/page_words.h"
#include "view/population_route.h"
#include "view/recording_routes.h"
#include "view/view_items.h"

namespace rheocyte {

namespace fs = std::filesystem;

namespace {

/// Of what each thread's session keeps; a ladder of meshes for one cell takes a tenth of it.
constexpr std::size_t session_bytes = std::size_t(48) << 20;
constexpr auto look_for_signals = std::chrono::milliseconds(50);

bool is_loopback(const std::string& host) { return host.starts_with("127.") || host == "localhost" || host == "::1"; }

/// Files of sessions, and all others.
std::pair<std::vector<fs::path>, std::vector<fs::path>> split_paths(const std::vector<fs::path>& paths) {
  std::pair<std::vector<fs::path>, std::vector<fs::path>> split;
  for (const fs::path& path : paths) (ViewSession::is_session(path) ? split.first : split.second).push_back(path);
  return split;
}

void announce(const HttpServer& server, const ViewOptions& options) {
  print(fmt::format("view: {}\n", server.address()));
  finish_output();
  if (!is_loopback(options.place.host))
    tell(
        "rheocyte view: whoever reaches this address and knows the token can compute here and write into the output "
        "folder; the connection is not encrypted.");
}

/// Until the user wants a stop.
void wait_beside(const HttpServer& server, const ViewOptions& options) {
  std::optional<StartedBrowser> browser;
  if (options.opens_browser) browser.emplace(server.address_of_once());
  while (!stop_wanted()) {
    if (browser && browser->has_just_failed())
      tell("rheocyte view: no browser could be opened; open the address above in one.");
    std::this_thread::sleep_for(look_for_signals);
  }
}

}  // namespace

void serve_view(const ViewOptions& options) {
  const auto [sessions, items_paths] = split_paths(options.paths);
  ViewItems items(items_paths);  // first of all: it starts processes, and there are no threads yet
  ExportFolder folder(options.output);
  SolverThreads threads(std::max(1U, std::thread::hardware_concurrency()), session_bytes);
  Router router(in_words_of_page);
  Exports exports(folder);
  ViewSession session;
  add_declaration_routes(router);
  add_cell_routes(router, exports, threads);
  add_recording_routes(router, exports, session, items);
  add_population_route(router, items);
  session.add_routes(router, exports);
  exports.add_route(router);
  for (const auto& file : sessions) session.read(file);
  const Assets assets(Assets::usual_folder());
  HttpServer server(router, assets, options.place, new_token());
  watch_signals();
  for (const auto& sentence : items.missing()) tell("rheocyte view: " + sentence);
  Thread thread([&](const std::stop_token&) { server.run(); }, small_stack);
  announce(server, options);
  wait_beside(server, options);
  server.stop();
  thread.join();
}

}  // namespace rheocyte

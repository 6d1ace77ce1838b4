#include "view/view.h"

#include <fmt/format.h>

#include <chrono>
#include <optional>
#include <thread>

#include "serve/access.h"
#include "serve/open_browser.h"
#include "store/standard_error.h"
#include "store/standard_output.h"
#include "store/stop_signal.h"
#include "store/thread.h"
#include "view/view_routes.h"

namespace rheocyte {

namespace {

constexpr auto look_for_signals = std::chrono::milliseconds(50);

bool is_loopback(const std::string& host) { return host.starts_with("127.") || host == "localhost" || host == "::1"; }

void announce(const HttpServer& server, const ViewOptions& options) {
  print(fmt::format("view: {}\n", server.address()));
  finish_output();
  if (!is_loopback(options.place.host))
    tell(
        "rheocyte view: anyone who can reach this address and knows the token can compute on this machine and write "
        "into the output folder; the connection is not encrypted.");
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
  ViewRoutes routes(options.paths, options.output);  // first of all: it starts processes, and there are no threads yet
  const Assets assets(Assets::usual_folder());
  HttpServer server(routes.router(), assets, options.place, new_token());
  watch_signals();
  for (const auto& sentence : routes.items().missing()) tell("rheocyte view: " + sentence);
  Thread thread([&](const std::stop_token&) { server.run(); }, small_stack);
  announce(server, options);
  wait_beside(server, options);
  server.stop();
  thread.join();
}

}  // namespace rheocyte

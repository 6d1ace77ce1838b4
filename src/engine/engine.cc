// The program for a page without a server: what page/src/api.ts asks comes in as text, the answer goes out in pieces.
#include <emscripten.h>

#include <array>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "serve/http.h"
#include "serve/target.h"
#include "view/view_routes.h"

// What the worker (page/src/alone/worker.ts) adds to the module.
EM_JS(void, engine_head, (int status, const char* type, const char* headers),
      { Module.takeHead(status, UTF8ToString(type), JSON.parse(UTF8ToString(headers))); })
EM_JS(int, engine_is_wanted, (), { return Module.isWanted(); })  // a promise where the browser can wait for one
EM_JS(void, engine_piece, (const char* from, int size), {
  const first = from >>> 0;  // beyond 2 GB it arrives negative
  Module.takePiece(HEAPU8.slice(first, first + size));
})

namespace rheocyte {

namespace {

/// The page, of which the worker knows whether it still waits.
class Page : public Client {
 public:
  bool has_left() const override { return engine_is_wanted() == 0; }
};

std::optional<ViewRoutes>& routes() {
  static std::optional<ViewRoutes> all;
  return all;
}

void give_head(const Answer& answer) {
  nlohmann::ordered_json headers = nlohmann::ordered_json::object();
  for (const auto& [name, value] : answer.headers) headers[name] = value;
  engine_head(answer.status, answer.type.c_str(), headers.dump().c_str());
}

bool give_piece(std::string_view piece) {
  engine_piece(piece.data(), static_cast<int>(piece.size()));
  return true;
}

void answer(Request request) {
  const Answer answer = routes()->router().answer(std::move(request));
  give_head(answer);
  if (!answer.give_pieces) {
    give_piece(answer.body);
    return;
  }
  try {
    answer.give_pieces(give_piece);
  } catch (const std::exception&) {  // an answer that breaks off, as over HTTP
  }
}

}  // namespace

}  // namespace rheocyte

extern "C" {

/// Before all others: where the tables are, and where exports go.
EMSCRIPTEN_KEEPALIVE void rheocyte_start(const char* tables, const char* exports) {
  ::setenv("RHEOCYTE_TABLES", tables, 1);
  const std::array<std::filesystem::path, 0> nothing{};
  rheocyte::routes().emplace(nothing, exports);
}

/// `target` is path and query. Also called while another call asks whether the page still waits: by what reads no
/// recording and solves nothing.
EMSCRIPTEN_KEEPALIVE void rheocyte_request(const char* method, const char* target, const char* body, int size) {
  static const rheocyte::Page page;
  rheocyte::Target asked = rheocyte::read_target(target);
  rheocyte::answer({.method = method,
                    .path = std::move(asked.path),
                    .query = std::move(asked.query),
                    .body = std::string(body, static_cast<std::size_t>(size)),
                    .client = &page});
}

/// The same in the table of functions, where it can be called as a promise.
EMSCRIPTEN_KEEPALIVE void* rheocyte_entry() { return reinterpret_cast<void*>(&rheocyte_request); }

EMSCRIPTEN_KEEPALIVE int rheocyte_count() { return static_cast<int>(rheocyte::routes()->items().count()); }

/// Lists a file that the page has put into the file system, or restores a session. Returns why not, or nothing.
EMSCRIPTEN_KEEPALIVE const char* rheocyte_open(const char* path) {
  static std::string reason;
  reason.clear();
  try {
    rheocyte::routes()->open(path);
  } catch (const std::exception& error) {
    reason = error.what();
  }
  return reason.c_str();
}
}
